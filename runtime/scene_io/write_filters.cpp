// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/write_parts.h"

namespace pointrt {

void putSelection(SceneWriting& writing, const SplatSelection& selection) {
    put(writing, "attribute", tomlOf(selection.attribute));
    std::string values;
    for (const ValueRange& range : selection.ranges) {
        if (range.low < range.high) return put(writing, "range", listOf({tomlOf(range.low), tomlOf(range.high)}));
        values += (values.empty() ? "" : ", ") + tomlOf(range.low);
    }
    put(writing, "values", "[" + values + "]");
}

void writeFilters(SceneWriting& writing) {
    for (const FilterDescription& filter : writing.scene.filters) {
        if (filter.shown.ranges.empty()) continue;
        begin(writing, "[[filter]]");
        putSelection(writing, filter.shown);
        if (!filter.enabled) put(writing, "enabled", "false");
    }
}

} // namespace pointrt

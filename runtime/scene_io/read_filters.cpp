// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/read_parts.h"

namespace pointrt {

void readFilters(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "filter")) {
        requireKnownKeys(table, "a filter", {"attribute", "values", "range", "enabled"});
        const SceneValue attribute = require(table, "attribute");
        FilterDescription filter{selectionOf(table, attribute), true, placeOf(attribute)};
        takeFlag(table, "enabled", filter.enabled);
        reading.scene.filters.push_back(std::move(filter));
    }
}

} // namespace pointrt

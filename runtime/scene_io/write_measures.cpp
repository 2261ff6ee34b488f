// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/write_parts.h"

namespace pointrt {

void writeMeasures(SceneWriting& writing) {
    for (const MeasureDescription& measure : writing.scene.measures) {
        begin(writing, "[[measure]]");
        std::string points;
        for (const Vec3 point : measure.points) points += (points.empty() ? "" : ", ") + tomlOf(point);
        put(writing, "points", "[" + points + "]");
        if (measure.closed) put(writing, "closed", "true");
        if (!measure.visible) put(writing, "visible", "false");
        putLayer(writing, measure.layer);
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/scene_io/read_parts.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

ClipBox clipBoxOf(const SceneValue& table) {
    ClipBox box{vectorOf(require(table, "min")), vectorOf(require(table, "max"))};
    const Vec3 size = box.high - box.low;
    if (std::min({size.x, size.y, size.z}) < kSmallest)
        refuse(*find(table, "max"), "must be above \"min\" in x, y and z");
    if (const auto rotate = find(table, "rotate")) box.rotation = rotationOf(*rotate);
    return box;
}

ClipDescription clipOf(const SceneValue& table) {
    const bool is_box = choiceOf(require(table, "type"), {"box", "plane"}) == 0;
    ClipDescription clip;
    if (is_box) {
        requireKnownKeys(table, "a box", {"type", "enabled", "name", "locked", "min", "max", "rotate"});
        clip.form = clipBoxOf(table);
    } else {
        requireKnownKeys(table, "a plane", {"type", "enabled", "name", "locked", "point", "normal"});
        clip.form = ClipPlane{vectorOf(require(table, "point")), directionOf(require(table, "normal"))};
    }
    takeFlag(table, "enabled", clip.enabled);
    takeLayer(table, clip.layer);
    return clip;
}

} // namespace

void readClips(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "clip")) {
        reading.scene.clips.push_back(clipOf(table));
        if (countHalfSpaces(reading.scene.clips) > MAX_CLIP_PLANES)
            refuse(table, "more than 32 clip planes in all; a box counts as six");
    }
}

} // namespace pointrt

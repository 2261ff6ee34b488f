// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/read_parts.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

void readImage(const SceneValue& table, const SceneReading& reading, SkyDescription& sky) {
    forbid(table, {"color", "zenith", "horizon", "ground"}, "cannot be combined with \"image\"");
    const SceneValue image = require(table, "image");
    if (reading.scene.lights.size() == MAX_LIGHTS)
        refuse(image, "counts as a light, and the scene already has 32, the most allowed");
    sky.image = fileOf(image, reading);
    if (!sky.image.ends_with(".hdr") && !sky.image.ends_with(".exr")) refuse(image, "must end in .hdr or .exr");
    takeNumber(table, "rotation", {-360, 360}, sky.rotation_deg);
}

void readColors(const SceneValue& table, SkyDescription& sky) {
    forbid(table, {"rotation"}, "has no effect without \"image\"");
    if (find(table, "color")) {
        forbid(table, {"zenith", "horizon", "ground"}, "cannot be combined with \"color\"");
        takeColor(table, "color", kLightValues, sky.zenith);
        sky.horizon = sky.ground = sky.zenith;
        return;
    }
    takeColor(table, "zenith", kLightValues, sky.zenith);
    takeColor(table, "horizon", kLightValues, sky.horizon);
    takeColor(table, "ground", kLightValues, sky.ground);
}

} // namespace

void readSky(const SceneValue& file, SceneReading& reading) {
    const auto table = findTable(file, "sky");
    if (!table) return;
    requireKnownKeys(*table, "a sky",
                     {"color", "zenith", "horizon", "ground", "image", "rotation", "strength", "ambient"});
    SkyDescription sky;
    if (find(*table, "image"))
        readImage(*table, reading, sky);
    else
        readColors(*table, sky);
    takeNumber(*table, "strength", {0, 1e6}, sky.strength);
    takeNumber(*table, "ambient", kShares, sky.ambient);
    reading.scene.sky = sky;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/write_parts.h"

namespace pointrt {
namespace {

void putLight(SceneWriting& writing, const PointLight& light) {
    put(writing, "type", "\"point\"");
    put(writing, "position", tomlOf(light.position));
    put(writing, "intensity", tomlOf(light.intensity));
}

void putLight(SceneWriting& writing, const SpotLight& light) {
    put(writing, "type", "\"spot\"");
    put(writing, "position", tomlOf(light.position));
    put(writing, "direction", tomlOf(light.direction));
    put(writing, "outer", tomlOf(light.outer_deg));
    put(writing, "inner", tomlOf(light.inner_deg));
    put(writing, "intensity", tomlOf(light.intensity));
}

void putLight(SceneWriting& writing, const SunLight& light) {
    put(writing, "type", "\"sun\"");
    put(writing, "towards", tomlOf(light.towards));
    put(writing, "angular_radius", tomlOf(light.radius_deg));
    put(writing, "irradiance", tomlOf(light.irradiance));
}

void putLight(SceneWriting& writing, const SphereLight& light) {
    put(writing, "type", "\"sphere\"");
    put(writing, "center", tomlOf(light.center));
    put(writing, "radius", tomlOf(light.radius));
    put(writing, "radiance", tomlOf(light.radiance));
    if (!light.seen_by_camera) put(writing, "seen_by_camera", "false");
}

void putLight(SceneWriting& writing, const QuadLight& light) {
    put(writing, "type", "\"quad\"");
    put(writing, "center", tomlOf(light.center));
    put(writing, "u", tomlOf(light.u));
    put(writing, "v", tomlOf(light.v));
    put(writing, "radiance", tomlOf(light.radiance));
    if (!light.seen_by_camera) put(writing, "seen_by_camera", "false");
}

} // namespace

void writeLights(SceneWriting& writing) {
    for (const LightDescription& light : writing.scene.lights) {
        begin(writing, "[[light]]");
        std::visit([&](const auto& kind) { putLight(writing, kind); }, light);
    }
}

} // namespace pointrt

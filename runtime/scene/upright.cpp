// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/upright.h"

#include <array>

#include "format/base/error.h"
#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

constexpr std::array kAxisNames = {Name{"x", Vec3{1, 0, 0}},   Name{"y", Vec3{0, 1, 0}},   Name{"z", Vec3{0, 0, 1}},
                                   Name{"-x", Vec3{-1, 0, 0}}, Name{"-y", Vec3{0, -1, 0}}, Name{"-z", Vec3{0, 0, -1}}};

/// Below this sine north is no direction along the ground: lengths that scene files take begin there.
constexpr double kAlong = 1e-9;

void putUpSuns(SceneDescription& scene, Vec3 up) {
    for (const SunInTheSky& sun : scene.suns) {
        const Vec3 north = sun.north.value_or(defaultNorth(up));
        if (length(cross(north, up)) < kAlong)
            throw Error{ExitCode::kBadInput, sun.place + "must not be along the scene's \"up\""};
        std::get<SunLight>(scene.lights.at(sun.light)).towards = sunDirection(sun.position, up, north);
    }
    scene.suns.clear();
}

void lookAtFront(CameraRequest& camera, Vec3 up) {
    if (camera.up) return;
    camera.up = up;
    camera.side = frontSide(up);
}

} // namespace

std::string axisName(Vec3 axis) { return nameOf(kAxisNames, axis); }

std::optional<Vec3> axisNamed(const std::string& word) {
    for (const auto& [name, axis] : kAxisNames)
        if (word == name) return axis;
    return std::nullopt;
}

void standUpright(SceneDescription& scene, CameraRequest& camera, CameraRequest& staging,
                  const UprightRequest& request) {
    // a camera that a lone scan is given says what is up there as well
    const bool is_said = scene.up || (!request.fallback && camera.up);
    if (!is_said && request.known) {
        scene.up = request.known;
        lookAtFront(camera, *scene.up);
        lookAtFront(staging, *scene.up);
        for (NamedView& view : scene.views) lookAtFront(view.camera, *scene.up);
    }
    if (!scene.up) scene.up = request.fallback;
    if (scene.up) putUpSuns(scene, *scene.up);
}

} // namespace pointrt

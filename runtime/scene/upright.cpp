// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/upright.h"

#include "format/base/axis_name.h"
#include "format/base/error.h"
#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

/// Sine of the angle between north and up below which north has no usable horizontal part; also the shortest length
/// that scene files accept.
constexpr double kNorthParallelSine = 1e-9;

void placeSuns(SceneDescription& scene, Vec3 up) {
    for (const SunInTheSky& sun : scene.suns) {
        const Vec3 north = sun.north.value_or(defaultNorth(up));
        if (length(cross(north, up)) < kNorthParallelSine)
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

std::string axisName(Vec3 axis) { return nameOfDirection({axis.x, axis.y, axis.z}); }

std::optional<Vec3> axisNamed(const std::string& word) {
    const auto axis = directionNamed(word);
    return axis ? std::optional(Vec3{(*axis)[0], (*axis)[1], (*axis)[2]}) : std::nullopt;
}

std::optional<Vec3> nearestAxis(Vec3 direction) {
    const Vec3 size = absolute(direction);
    if (!(length(size) > 0)) return std::nullopt;
    if (size.z >= size.x && size.z >= size.y) return Vec3{0, 0, direction.z < 0 ? -1.0 : 1.0};
    if (size.y >= size.x) return Vec3{0, direction.y < 0 ? -1.0 : 1.0, 0};
    return Vec3{direction.x < 0 ? -1.0 : 1.0, 0, 0};
}

void resolveUp(SceneDescription& scene, CameraRequest& camera, CameraRequest& staging, const UpRequest& request) {
    // for a single scan, the camera's up, if given, is also the scene's
    const bool is_given = scene.up || (!request.fallback && camera.up);
    if (!is_given && request.known) {
        scene.up = request.known;
        lookAtFront(camera, *scene.up);
        lookAtFront(staging, *scene.up);
        for (NamedView& view : scene.views) lookAtFront(view.camera, *scene.up);
    }
    if (!scene.up) scene.up = request.fallback;
    if (scene.up) placeSuns(scene, *scene.up);
}

} // namespace pointrt

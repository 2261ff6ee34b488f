// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/picture_camera.h"

#include <cmath>
#include <stdexcept>

#include "format/base/error.h"
#include "runtime/api/setting_names.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/camera_range.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/framing.h"
#include "runtime/scene/pinhole.h"

namespace pointrt {
namespace {

std::optional<Vec3> vectorOf(const std::optional<std::array<double, 3>>& numbers) {
    if (!numbers) return std::nullopt;
    return Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/// Merges the caller's camera with the scene's, as resolveSettings and resolveUp do for the command line.
CameraRequest requestOf(const LookAt& said, const LoadedScene& loaded, CameraRequest camera) {
    if (const auto eye = vectorOf(said.eye)) camera.eye = eye;
    if (const auto target = vectorOf(said.target)) camera.target = target;
    if (const auto up = vectorOf(said.up)) camera.up = up;
    if (said.fov_deg) {
        camera.fov_deg = *said.fov_deg;
        camera.ortho = false;
        camera.ortho_height.reset();
    }
    const std::optional<Vec3> scene_up = loaded.scene.description.up;
    if (!camera.up && scene_up) {
        camera.up = scene_up;
        camera.side = frontSide(*scene_up);
    }
    return camera;
}

Camera framedCamera(const LookAt& said, const LoadedScene& loaded, const LoadRequest& request, PixelSize size) {
    const bool faces_section = loaded.section_camera && !said.eye && !said.target;
    const CameraRequest wanted =
        faces_section ? *loaded.section_camera : requestOf(said, loaded, request.settings.camera);
    const double aspect = static_cast<double>(size.width) / size.height;
    const bool fov_is_free = !said.fov_deg && request.fov_is_free;
    const Vec3 up = sceneUp(loaded.scene.description, loaded.settings);
    return namingSettings([&] {
        const FramedRequest framed =
            frameScene(wanted, loaded.kept_sample, up, {aspect, loaded.free_share}, fov_is_free);
        return frameCamera(framed.camera, loaded.scene.bounds.lo, loaded.scene.bounds.hi, aspect);
    });
}

CameraPose poseOf(const std::array<double, 16>& m) {
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
        throw std::invalid_argument("the last row of world_from_camera is not 0 0 0 1");
    return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

Camera machineCamera(const PinholeCamera& said, const LoadedScene& loaded, PixelSize size) {
    try {
        const CameraPose pose = poseOf(said.world_from_camera);
        const Camera camera = pinholeCamera(pose, {said.fx, said.fy, said.cx, said.cy}, size);
        if (!isWithinCameraRange(pose.eye, loaded.scene.bounds.lo, loaded.scene.bounds.hi))
            throw std::invalid_argument("it is more than 10000 scene radii away");
        return camera;
    } catch (const std::invalid_argument& error) {
        throw Error{ExitCode::kBadUsage, std::string("camera: ") + error.what()};
    }
}

} // namespace

Camera sceneCamera(const PictureCamera& camera, const LoadedScene& loaded, const LoadRequest& request, PixelSize size) {
    if (const auto* pinhole = std::get_if<PinholeCamera>(&camera)) return machineCamera(*pinhole, loaded, size);
    return framedCamera(std::get<LookAt>(camera), loaded, request, size);
}

} // namespace pointrt

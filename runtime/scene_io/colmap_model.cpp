// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/colmap_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/util/parse.h"

namespace pointrt {
namespace {

/// The models of COLMAP 4.2, src/colmap/sensor/models.h.
constexpr ColmapModel kModels[] = {{0, "SIMPLE_PINHOLE", 3, 1, true},
                                   {1, "PINHOLE", 4, 2, true},
                                   {2, "SIMPLE_RADIAL", 4, 1, true},
                                   {3, "RADIAL", 5, 1, true},
                                   {4, "OPENCV", 8, 2, true},
                                   {5, "OPENCV_FISHEYE", 8, 2, false},
                                   {6, "FULL_OPENCV", 12, 2, true},
                                   {7, "FOV", 5, 2, false},
                                   {8, "SIMPLE_RADIAL_FISHEYE", 4, 1, false},
                                   {9, "RADIAL_FISHEYE", 5, 1, false},
                                   {10, "THIN_PRISM_FISHEYE", 12, 2, false},
                                   {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, false},
                                   {12, "SIMPLE_DIVISION", 4, 1, true},
                                   {13, "DIVISION", 5, 2, true},
                                   {14, "SIMPLE_FISHEYE", 3, 1, false},
                                   {15, "FISHEYE", 4, 2, false},
                                   {16, "EUCM", 6, 2, false},
                                   {17, "EQUIRECTANGULAR", 2, 0, false}};

template <typename Holds>
const ColmapModel* modelWhere(const Holds& holds) {
    const auto* const found = std::find_if(std::begin(kModels), std::end(kModels), holds);
    return found == std::end(kModels) ? nullptr : found;
}

PinholeLens lensOf(const ColmapCamera& camera) {
    const std::vector<double>& p = camera.parameters;
    if (camera.model->focal_lengths == 1) return {p[0], p[0], p[1], p[2]};
    return {p[0], p[1], p[2], p[3]};
}

std::string distortionOf(const ColmapCamera& camera) {
    const auto first = camera.parameters.begin() + static_cast<std::ptrdiff_t>(camera.model->focal_lengths + 2);
    if (std::all_of(first, camera.parameters.end(), [](double value) { return value == 0; })) return "";
    std::string text = camera.model->name;
    for (auto each = first; each != camera.parameters.end(); ++each) text += " " + plainText(*each);
    return text;
}

/// The rows of camera_from_world's rotation matrix are the camera's axes in the world.
CameraPose poseOf(const ColmapImage& image) {
    const auto [qw, qx, qy, qz] = image.rotation;
    const double size = std::sqrt(qw * qw + qx * qx + qy * qy + qz * qz);
    if (!(size > 0) || !std::isfinite(size)) throw std::invalid_argument("its quaternion is zero");
    const double w = qw / size, x = qx / size, y = qy / size, z = qz / size;
    CameraPose pose;
    pose.right = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)};
    pose.down = {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)};
    pose.forward = {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
    const auto [tx, ty, tz] = image.translation;
    pose.eye = -1.0 * (tx * pose.right + ty * pose.down + tz * pose.forward);
    return pose;
}

} // namespace

const ColmapModel* colmapModel(std::int32_t id) {
    return modelWhere([&](const ColmapModel& model) { return model.id == id; });
}

const ColmapModel* colmapModel(const std::string& name) {
    return modelWhere([&](const ColmapModel& model) { return model.name == name; });
}

CameraShot colmapShot(const ColmapImage& image, const ColmapCameras& cameras, const std::string& place) {
    const auto camera = cameras.find(image.camera);
    if (camera == cameras.end())
        throw std::invalid_argument("camera " + std::to_string(image.camera) + " is not in the file of cameras");
    if (!camera->second.model->is_pinhole)
        throw std::invalid_argument(std::string("its camera model is ") + camera->second.model->name +
                                    ", not a pinhole; undistort the images first");
    return {
        image.name, place, camera->second.size, lensOf(camera->second), poseOf(image), distortionOf(camera->second)};
}

} // namespace pointrt

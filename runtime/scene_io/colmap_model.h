// SPDX-License-Identifier: Apache-2.0
// COLMAP's camera models and poses (https://colmap.github.io/format.html, cameras.html).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

struct ColmapModel {
    std::int32_t id;  ///< in cameras.bin
    const char* name; ///< in cameras.txt
    std::size_t parameters;
    std::size_t focal_lengths; ///< 1 or 2, followed by the principal point and distortion parameters
    bool is_pinhole;           ///< apart from distortion
};

/// Null for an unknown model.
const ColmapModel* colmapModel(std::int32_t id);
const ColmapModel* colmapModel(const std::string& name);

/// A row of cameras.bin or cameras.txt.
struct ColmapCamera {
    const ColmapModel* model = nullptr;
    PixelSize size;
    std::vector<double> parameters; ///< as many as the model has
};
using ColmapCameras = std::map<std::uint32_t, ColmapCamera>;

/// A row of images.bin or images.txt.
struct ColmapImage {
    std::array<double, 4> rotation; ///< camera_from_world: w, x, y, z
    std::array<double, 3> translation;
    std::uint32_t camera = 0;
    std::string name;
};

/// Throws std::invalid_argument with the reason for an unknown camera, a camera that is not a pinhole, or a zero
/// quaternion. place: of the image
CameraShot colmapShot(const ColmapImage& image, const ColmapCameras& cameras, const std::string& place);

} // namespace pointrt

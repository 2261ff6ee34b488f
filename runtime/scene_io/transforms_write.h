// SPDX-License-Identifier: Apache-2.0
// Writes transforms.json for rendered pictures, as input for nerfstudio and Instant-NGP.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

struct RenderedShot {
    CameraShot shot;
    /// Keys and files, relative to the list's folder: "file_path" and "rgb/0001.png", "depth_file_path" ...
    std::vector<std::pair<std::string, std::string>> files;
};

struct TransformsFile {
    std::vector<RenderedShot> shots;
    /// Subtracted from the cameras' positions, since training uses floats; written as applied_transform.
    Vec3 offset;
    double depth_unit = 0; ///< scene units per step of depth pictures; 0: there are none
};

/// Writes file to path, atomically. If offset is integral, readCameraList returns bit-identical cameras. Throws Error
/// kCannotWrite "PATH: reason".
void writeTransforms(const std::string& path, const TransformsFile& file);

/// The offset for a scene with these bounds: its centre, rounded to integers, if floats resolve less than a thousandth
/// of a unit there, else 0.
Vec3 offsetFor(Vec3 bounds_min, Vec3 bounds_max);

} // namespace pointrt

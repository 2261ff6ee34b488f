// SPDX-License-Identifier: Apache-2.0
// transforms.json for pictures that were rendered: what nerfstudio and Instant-NGP train on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

struct RenderedShot {
    CameraShot shot;
    /// Keys and the files they name, relative to the list's folder: "file_path" and "rgb/0001.png", "depth_file_path"
    /// ...
    std::vector<std::pair<std::string, std::string>> files;
};

struct TransformsFile {
    std::vector<RenderedShot> shots;
    /// What is taken off the cameras' places, and named as applied_transform: those who train work in floats.
    Vec3 offset;
    double depth_unit = 0; ///< of the whole numbers in depth pictures, in the scan's unit; 0: there are none
};

/// Writes it to path, all or nothing. Read again by readCameraList, its cameras are the same to the bit where offset is
/// whole. Throws Error kCannotWrite "PATH: reason".
void writeTransforms(const std::string& path, const TransformsFile& file);

/// What to take off in a scene with these bounds: whole numbers near its middle, where floats would tell less than a
/// thousandth of a unit, else nothing.
Vec3 offsetFor(Vec3 bounds_min, Vec3 bounds_max);

} // namespace pointrt

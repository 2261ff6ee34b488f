// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of a COLMAP model: the positions of their cameras.
#pragma once

#include <string>
#include <unordered_map>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/input_file.h"

namespace pointrt {

struct ColmapImage {
    std::string name;
    Vec3d center = Vec3d::Zero(); ///< of the camera, in the frame of the points
    Vec3d up = Vec3d::Zero();     ///< of the picture, in the same frame, of unit length
};

using ColmapImages = std::unordered_map<std::uint32_t, ColmapImage>; ///< by IMAGE_ID

/// Reads images.bin or images.txt. Throws Error if the file is malformed.
ColmapImages readColmapImages(const InputFile& input);

} // namespace pointrt

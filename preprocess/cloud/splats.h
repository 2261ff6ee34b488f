// SPDX-License-Identifier: GPL-3.0-or-later
// Oriented discs and balls: output of the surface estimation, input of the octree.
#pragma once

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Splats in the frame of the cloud. All arrays have the same length, except where noted. They follow a Morton curve,
/// so that neighbours in space are mostly neighbours in memory.
struct Splats {
    Vec3d origin = Vec3d::Zero(); ///< input coordinate = origin + position
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< unit length; 0: the splat is a ball
    std::vector<float> radii;   ///< input units, > 0, finite
    std::vector<Rgb8> colors;   ///< sRGB, or empty
    /// Index of each splat's point in the cloud; from input_count on for splats that fill gaps between points.
    std::vector<std::uint32_t> input_index;
    std::uint32_t input_count = 0; ///< points of the cloud as read
    /// For filling splat input_count + i: index in the cloud of the point that it copies attributes from.
    std::vector<std::uint32_t> filled_from;
    /// Standard deviation of the surface around each splat after cleaning, input units; empty if the cloud is clean.
    std::vector<float> noise;
    bool oriented = false; ///< normals point outwards, as far as can be determined
};

} // namespace pointrt

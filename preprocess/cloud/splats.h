// SPDX-License-Identifier: GPL-3.0-or-later
// Oriented discs with a radius each: what surface estimation hands to the octree.
#pragma once

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Discs in the cloud's frame; all arrays but colors have the same length, colors may be empty.
/// They stand along a Morton curve, so that neighbours in space are mostly neighbours in memory.
struct Splats {
    Vec3d origin = Vec3d::Zero(); ///< input coordinate = origin + position
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< unit length
    std::vector<float> radii;   ///< input units, > 0, finite
    std::vector<Rgb8> colors;   ///< sRGB, or empty
    /// Index of each splat's point in the cloud; of a splat that fills a gap between points input_count and up.
    std::vector<std::uint32_t> input_index;
    std::uint32_t input_count = 0; ///< points of the cloud as read
    /// [filling splats], index in the cloud of the point whose attributes it carries: filling splat i has the input
    /// index input_count + i.
    std::vector<std::uint32_t> filled_from;
    /// Standard deviation of each splat across the surface, input units, as measured after cleaning; empty where the
    /// whole cloud is clean.
    std::vector<float> noise;
    bool oriented = false; ///< normals point outwards as far as can be told
};

} // namespace pointrt

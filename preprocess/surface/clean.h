// SPDX-License-Identifier: GPL-3.0-or-later
// Noise taken out of a cloud whose normals tell the sides.
#pragma once

#include <optional>

#include "preprocess/surface/noise.h"

namespace pointrt::surface {

/// What is known of points beside themselves.
struct CleanInput {
    float strength = 1;                       ///< multiplies the reach of smoothing, above 0
    bool keep_normals = false;                ///< as they are; else they are those of the surface that is found
    std::vector<std::uint32_t> scan_of_point; ///< [points], or empty where all are of one scan
    std::size_t scan_count = 1;
    std::vector<float> noise_of_scans; ///< [scans], as CleanReport::noise, where it was measured before; else empty
    std::vector<std::uint8_t> rims;    ///< [points], 1: at the rim of its scan's grid; or empty
};

struct CleanReport {
    std::vector<float> noise; ///< [scans], sigma over the spacing, before anything moved; empty of small clouds
    std::size_t dropped = 0, moved = 0;
    std::vector<float> support; ///< [points left], ProjectionReport::support; empty where all scans are clean
    std::vector<float> sigma;   ///< [points left], what is left of the noise; empty where all scans are clean
};

/// Measures the noise, of clouds of kFewForNoise points and more, where it is not known; of scans that have some
/// (kCleanNoise) drops the rims of their grids and moves the points onto the surface among them. lists and search are
/// made anew where anything was dropped or moved; else nothing changes. Points with a radius of their own neither move
/// nor go, nor count for the noise: they overlap by design, and what lies beside them is not what noise left. The
/// arrays of input lose what points lose.
CleanReport cleanPoints(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search, CleanInput& input,
                        const StageProgress& progress);

} // namespace pointrt::surface

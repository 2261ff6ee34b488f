// SPDX-License-Identifier: GPL-3.0-or-later
// Removes noise from points with oriented normals.
#pragma once

#include "preprocess/surface/noise.h"
#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

struct CleanOptions {
    float strength = 1;        ///< multiplies the support radius of smoothing, above 0
    bool keep_normals = false; ///< leaves normals as they are; otherwise they become those of the surface found
    std::size_t scan_count = 1;
    std::vector<float> noise_of_scans; ///< [scans], as CleanReport::noise, if measured before; otherwise empty
};

struct CleanReport {
    std::vector<float> noise; ///< [scans], sigma over the spacing, before anything moved; empty for small clouds
    std::size_t dropped = 0, moved = 0;
};

/// Measures the noise unless it is known (clouds of kFewForNoise points and more). In scans with more than kCleanNoise,
/// drops the points at silhouettes and moves the others onto the surface among them, sets their noise and support, and
/// rebuilds the graph. Otherwise changes nothing. Points with given radii are neither moved nor dropped, and do not
/// count for the noise: they overlap by design, and offsets between them are not noise.
CleanReport cleanPoints(PointGraph& graph, const CleanOptions& options, const StageProgress& progress);

} // namespace pointrt::surface

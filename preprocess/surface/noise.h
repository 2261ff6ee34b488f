// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how far points are off the surface that they sample.
#pragma once

#include <vector>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Samples of the noise of scans, of a whole cloud or of several places in it.
struct NoiseSamples {
    std::vector<std::vector<float>> over_spacing; ///< [scans], standard deviation across the surface over the spacing
    std::vector<std::size_t> in_clumps;           ///< [scans], samples in clumps
};

/// Adds one in `step` points, except those with given radii.
/// @param inner [points] 1: the neighbourhood is complete; only these count
void sampleNoise(const PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& inner,
                 std::size_t step, NoiseSamples& samples);

/// The noise of each scan, as by scanNoise; scans without samples get that of all scans together.
std::vector<float> noiseOf(NoiseSamples samples);

/// [scans], the median over a scan's points of the standard deviation across the surface, over the spacing; at most
/// four times that of its quietest points, as noise is everywhere; 0 for scans without points. Samples one point in 8,
/// except points with given radii. The deviation is the residual of a quadric through the neighbours, or the device's
/// own (given_noise) if that is larger. Needs normals, on either side.
std::vector<float> scanNoise(const PointSet& points, const NeighborLists& lists, std::size_t scan_count);

/// [points], the standard deviation around each point: the median over the point and its neighbours, because edges have
/// larger residuals, but are narrow. 0 for points with given radii; such neighbours do not count.
std::vector<float> localNoise(const PointSet& points, const NeighborLists& lists, const StageShare& share);

} // namespace pointrt::surface

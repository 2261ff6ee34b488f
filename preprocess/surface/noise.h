// SPDX-License-Identifier: GPL-3.0-or-later
// How far points lie off the surface that they were taken from.
#pragma once

#include <vector>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// [scans], the median over a scan's points of the standard deviation across the surface, over the spacing; 0 for scans
/// without points. Points with a radius of their own do not count. By one point in 8. The deviation is what a quadric
/// through the neighbours leaves unexplained, or what the device is known for where that is more.
/// @param scan_of_point [points], or empty where all are of one scan
/// Needs normals, on either side.
std::vector<float> noiseOfScans(const Points& points, const NeighborLists& lists,
                                const std::vector<std::uint32_t>& scan_of_point, std::size_t scan_count);

/// [points], the standard deviation at each place: the median of a point's and its neighbours', as an edge has more
/// but is narrow. 0 where a point has a radius of its own, and such neighbours do not count.
std::vector<float> noiseOfPlaces(const Points& points, const NeighborLists& lists, const StageShare& share);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of sight: no disc covers what a scanner looked through.
#pragma once

#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Shrinks discs down to where the line of sight to a measured point passes through them, as long as that point lies
/// clearly behind the disc: off its plane by more than the noise, and steeply enough that neither the surface's
/// curvature nor an error of the normal puts it there. A disc keeps half the way to its point's second neighbour.
/// Sensors of other scans count as well, from the third of their sights on and with more room behind the disc, as poses
/// err. A sensor that contradicts itself, as one does that a file names for a cloud put together of many scans, is not
/// believed, nor is one so far away that it stands for a direction (setSensorAlongZ).
/// @param measured points from there on were put between those of the scan (fillBetweenLines): nobody saw them
/// @param noise [points], standard deviation across the surface, or empty
/// @param sheets [points], sheetShares: discs of scattered points stay as they are; or empty, all are of surfaces
/// @param radii [points], of the discs
/// @return how many discs shrank; none where no sensor is known
/// The result does not depend on the number of threads.
std::size_t endAtSights(const Points& points, std::size_t measured, const NeighborLists& lists,
                        const std::vector<float>& noise, const std::vector<float>& sheets, std::vector<float>& radii,
                        const StageShare& share);

} // namespace pointrt::surface

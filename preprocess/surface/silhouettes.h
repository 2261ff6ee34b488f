// SPDX-License-Identifier: GPL-3.0-or-later
// Finds samples at silhouettes of range grids: mixed pixels, where the beam half hit an edge, and grazing hits.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// [points of the cloud], 1 for samples at a silhouette. Of a near scanner, a station: mixed pixels, from which the
/// surface steps forward on one side and back on the other; thin things and rims that it saw stay. Of a distant or
/// unknown one: samples beside an empty cell (unless a depth camera measured the point, Cloud::noise), or from which
/// the surface recedes 6 times as far along the line of sight as it extends across it; in range scans of the Stanford
/// Dragon, such samples are 0.23 to 0.47 mm outside the surface, others less than 0.15. Not a silhouette: the frame of
/// a grid, and a neighbour that was left out. Flags none of a grid if it would be more than half, as its cells are too
/// far apart. Empty if no sample is flagged.
std::vector<std::uint8_t> flagSilhouettes(const Cloud& cloud);

} // namespace pointrt

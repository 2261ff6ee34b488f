// SPDX-License-Identifier: GPL-3.0-or-later
// Finds samples at silhouettes of range grids: mixed pixels, where the beam half hit an edge, and grazing hits.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// [points of the cloud], 1 for samples at a silhouette.
///   - If the scanner was near (a station), only mixed pixels: the surface steps forward on one side and back on the
///     other. Thin objects and rims that it saw are not flagged.
///   - If it was far away or is unknown, samples beside an empty cell (unless a depth camera measured the point,
///     Cloud::noise), and those from which the surface recedes 6 times as far along the line of sight as it extends
///     across it. In range scans of the Stanford Dragon these are 0.23 to 0.47 mm outside the surface, others less than
///     0.15.
/// Neither the frame of a grid nor a neighbour that was left out makes a silhouette. If more than half of a grid would
/// be flagged, its cells are too far apart, and none is. Empty if no sample is flagged.
std::vector<std::uint8_t> flagSilhouettes(const Cloud& cloud);

} // namespace pointrt

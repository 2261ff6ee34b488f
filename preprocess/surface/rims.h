// SPDX-License-Identifier: GPL-3.0-or-later
// Samples at the rims of what a scanner saw: where its beam hit an edge half, or grazed the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// For each point of the cloud 1 where it lies at a rim of its grid: one of the 4 cells beside it is empty, unless
/// the scan came in steps of depth (Cloud::noise), or the surface there goes deeper than 6 times as far as it goes
/// across. (On range scans of the Stanford Dragon the ring of such samples lies 0.23 to 0.47 mm outside of the surface,
/// those further in below 0.15.) The frame of a grid is no rim, nor is a sample that was left out; and where the
/// scanner stood near, a surface that goes on steeply, as a floor does far away, is none. Empty where no grid has any:
/// so are grids of which more than half would be flagged, whose cells are too far apart to tell.
std::vector<std::uint8_t> flagRims(const Cloud& cloud);

} // namespace pointrt

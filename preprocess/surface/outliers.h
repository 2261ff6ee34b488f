// SPDX-License-Identifier: GPL-3.0-or-later
// Strays far off any surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Flags the points to keep: 0 marks a stray. Everything stays in clouds of fewer than 1000 points.
std::vector<std::uint8_t> flagKept(const Points& points, const NeighborLists& lists, const StageShare& share);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Normals by plane fits, on either side of the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt::surface {

/// Fills points.normals by source. Returns a flag for each point: 1 where its normal was given and is kept.
/// Throws Error (kBadInput) when kKeep lacks a normal.
std::vector<std::uint8_t> fillNormals(Points& points, const NeighborLists& lists, NormalSource source,
                                      const StageProgress& progress);

} // namespace pointrt::surface

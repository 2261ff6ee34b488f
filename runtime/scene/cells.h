// SPDX-License-Identifier: Apache-2.0
// The occupied cells of a grid over the splats of a sample.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/scene/scene_sample.h"

namespace pointrt {

using CellPlace = std::array<std::int32_t, 3>;

struct SampleCells {
    std::vector<CellPlace> places;      ///< of the occupied cells, in ascending order
    std::vector<std::uint32_t> counts;  ///< splats per cell
    std::vector<std::uint32_t> cell_of; ///< per splat, the index of its cell in places
};

/// The edge of a cell is a twentieth of denseBox's diagonal, or longer for sparse samples: at least half of the splats
/// are in cells of four or more. sample: not empty
SampleCells cellsOf(const SceneSample& sample);

/// A weight per splat, with sum 1: all cells have equal weight, however many splats a nearby scanner left in them.
std::vector<double> evenWeights(const SceneSample& sample);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The cubes of a grid that the splats of a sample lie in.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/scene/scene_sample.h"

namespace pointrt {

using CellPlace = std::array<std::int32_t, 3>;

struct SampleCells {
    std::vector<CellPlace> places;      ///< of cells with a splat in them, in rising order
    std::vector<std::uint32_t> counts;  ///< splats of each
    std::vector<std::uint32_t> cell_of; ///< for each splat its cell's index in places
};

/// Cells of a twentieth of denseBox's diagonal; of a sample that thin, so large that half of the splats share theirs
/// with three others. sample: not empty
SampleCells cellsOf(const SceneSample& sample);

/// A weight for each splat, 1 in all: all cells weigh the same, however many splats a scanner near by has left in them.
std::vector<double> evenWeights(const SceneSample& sample);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The file's leaves are wide, because every border costs references; rays want short lists. So each leaf becomes a
// brick of 3 x 3 x 3 cells on the device, with a list for each cell that a disc crosses.
#pragma once

#include <cstdint>
#include <vector>

#include "pointrt/pro.h"

namespace pointrt {

/// The words that the shaders read (layout: shaders/brick_layout.h).
struct Bricks {
    std::vector<std::uint32_t> bricks; ///< BRICK_WORDS for each leaf of the file, in its order
    std::vector<std::uint32_t> cells;  ///< CELL_WORDS for each listed cell
    std::vector<std::uint32_t> lists;  ///< splats: of each cell first those whose discs cross it, then those that only
                                       ///< blend; padded to whole texels of four
};

/// Builds the bricks of a validated file on all cores. Throws std::bad_alloc, or Error (kCannotRun) when the lists
/// outgrow their words.
Bricks buildBricks(const pro_info& info, const pro_view& view);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the tile whose core contains a position.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "preprocess/tiles/plan.h"

namespace pointrt {

class TileFinder {
public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    explicit TileFinder(const SetPlan& plan);

    /// Its index in plan.tiles, or kNone. Exact: cores are half-open to the last bit of a double.
    std::uint32_t find(const Vec3d& position) const;

private:
    double grid_; ///< a power of two that divides the lattice's origin and the edge
    int shift_;   ///< edge = grid * 2^shift
    std::array<std::int64_t, 3> origin_{};
    std::int64_t cells_;               ///< of level 0 along the root's edge
    std::vector<std::uint64_t> codes_; ///< [tiles] Morton code of each tile's lowest level-0 cell
    std::vector<std::uint64_t> spans_; ///< [tiles] number of codes
};

} // namespace pointrt

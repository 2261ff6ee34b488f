// SPDX-License-Identifier: GPL-3.0-or-later
// Which tile's core a position lies in.
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

    /// Its number in plan.tiles, or kNone. Exact: cores are half-open to the last bit of a double.
    std::uint32_t find(const Vec3d& position) const;

private:
    double grid_; ///< a power of two that the lattice's origin is a multiple of, and the edge too
    int shift_;   ///< the edge is so many doublings of it
    std::array<std::int64_t, 3> origin_{};
    std::int64_t cells_;               ///< of level 0 along the root's edge
    std::vector<std::uint64_t> codes_; ///< [tiles] Morton codes of their lowest cells of level 0
    std::vector<std::uint64_t> spans_; ///< how many codes each has
};

} // namespace pointrt

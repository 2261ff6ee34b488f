// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/core_reach.h"

#include <optional>

#include "runtime/device_scene/cut.h"

namespace pointrt {
namespace {

/// A face of a cell: the low or the high one along an axis.
struct Side {
    std::size_t axis = 0;
    bool high = false;
};

class Neighbors {
public:
    Neighbors(const TileSet& set, const std::vector<bool>& in_cut) : set_(set), in_cut_(in_cut) {}

    double growthAt(const SetTile& tile, Side side) const {
        TileCell steps{};
        steps[side.axis] = side.high ? 1 : -1;
        const TileCell beside = cellBeside(tile.cell, steps);
        if (const auto coarse = coveredBy(tile.level, beside))
            return set_.tiles[*coarse].level > tile.level ? set_.tiles[*coarse].error : 0;
        const bool filled = isFilled(tile.level, beside, {side.axis, !side.high});
        return filled ? 0 : set_.levels[tile.level].radius_max * 2 * edgeOf(set_, tile.level);
    }

private:
    /// The tile of the cut that contains a cell, if any.
    std::optional<std::uint32_t> coveredBy(std::uint32_t level, TileCell cell) const {
        for (; level < set_.levels.size(); ++level, cell = parentOf(cell)) {
            const auto tile = findTile(set_, level, cell);
            if (tile && in_cut_[*tile]) return tile;
        }
        return std::nullopt;
    }

    /// Whether tiles of the cut cover a side of a cell. The cell must lie in no coarser tile of the cut.
    bool isFilled(std::uint32_t level, const TileCell& cell, Side side) const {
        const auto tile = findTile(set_, level, cell);
        if (!tile) return false;
        if (in_cut_[*tile]) return true;
        for (unsigned corner = 0; corner < 8; ++corner) {
            if ((corner >> side.axis & 1) != (side.high ? 1u : 0u)) continue;
            TileCell child;
            for (std::size_t axis = 0; axis < 3; ++axis)
                child[axis] =
                    static_cast<std::int32_t>(2 * static_cast<std::uint32_t>(cell[axis]) + (corner >> axis & 1));
            if (level == 0 || !isFilled(level - 1, child, side)) return false;
        }
        return true;
    }

    const TileSet& set_;
    const std::vector<bool>& in_cut_;
};

} // namespace

TileBox hitBox(const TileSet& set, const std::vector<bool>& in_cut, std::uint32_t tile) {
    const Neighbors neighbors(set, in_cut);
    TileBox box = coreOf(set, set.tiles[tile]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] -= neighbors.growthAt(set.tiles[tile], {axis, false});
        box.high[axis] += neighbors.growthAt(set.tiles[tile], {axis, true});
    }
    return box;
}

} // namespace pointrt

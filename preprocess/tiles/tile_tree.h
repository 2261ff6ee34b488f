// SPDX-License-Identifier: GPL-3.0-or-later
// The tiles of a set and their neighbours.
#pragma once

#include <map>
#include <vector>

#include "preprocess/tiles/lattice.h"

namespace pointrt {

/// The original tiles, which are the leaves, and all of their ancestors up to one root.
class TileTree {
public:
    /// originals: at least one; none within another. Throws Error (kCannotRun) if no tile contains them all: cells
    /// below 0 and from 0 on have no common ancestor.
    explicit TileTree(const std::vector<TileKey>& originals);

    /// All tiles, in TileSet's order: highest level first.
    const std::vector<TileKey>& tiles() const { return tiles_; }
    TileKey root() const { return tiles_.front(); }
    bool has(const TileKey& tile) const { return original_.contains(tile); }
    bool isOriginal(const TileKey& tile) const;
    std::vector<TileKey> childrenOf(const TileKey& tile) const;
    /// The original tile whose core contains a position; nullopt if there is none.
    std::optional<TileKey> originalAt(const TileKey& tile, const PositionCode& code) const;

    /// The other tiles whose splats may extend into this one's core, in TileSet's order. An original tile's neighbours
    /// are the original tiles, of any level, whose cores overlap its cube. A merged tile's neighbours are those of its
    /// level and, where that level has none, original tiles of higher levels.
    std::vector<TileKey> neighborsOf(const TileKey& tile) const;

private:
    void addOriginalsBelow(const TileKey& tile, const TileKey& around, std::vector<TileKey>& found) const;
    void addOriginalAbove(TileKey tile, std::vector<TileKey>& found) const;

    std::vector<TileKey> tiles_;
    std::map<TileKey, bool> original_;
};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Which tiles a set has, and which of them lie beside which.
#pragma once

#include <map>
#include <vector>

#include "preprocess/tiles/lattice.h"

namespace pointrt {

/// The original tiles, which are the leaves, and all of their ancestors up to one root.
class TileTree {
public:
    /// originals: none within another; at least one. Throws Error (kCannotRun) where no tile holds them all, as cells
    /// below 0 and from 0 on never meet.
    explicit TileTree(const std::vector<TileKey>& originals);

    /// In TileSet's order: highest level first.
    const std::vector<TileKey>& tiles() const { return tiles_; }
    TileKey root() const { return tiles_.front(); }
    bool has(const TileKey& tile) const { return original_.contains(tile); }
    bool isOriginal(const TileKey& tile) const;
    std::vector<TileKey> childrenOf(const TileKey& tile) const;
    /// Whose core holds a position; nothing where no original tile stands.
    std::optional<TileKey> originalAt(const TileKey& tile, const PositionCode& code) const;

    /// The tiles whose splats may reach into this one's core, itself left out, in TileSet's order. An original tile's
    /// neighbours are the original tiles, of any level, whose cores meet its cube. A merged one's are those of its
    /// level, and original ones of higher levels, where no tile of its level stands.
    std::vector<TileKey> neighborsOf(const TileKey& tile) const;

private:
    void addOriginalsBelow(const TileKey& tile, const TileKey& around, std::vector<TileKey>& found) const;
    void addOriginalAbove(TileKey tile, std::vector<TileKey>& found) const;

    std::vector<TileKey> tiles_;
    std::map<TileKey, bool> original_;
};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Splat files whose tiles are made give their disk back.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// How many tiles are still to be made from each splat file. Its heads stay, which levels and set.json are made from.
class SplatReaders {
public:
    /// Drops what is needed no more. Throws Error as dropArrays.
    /// @param folder of the splat files; all of the tree's are there, and the coarser levels merged
    /// @param is_made tiles that are
    SplatReaders(const TileTree& tree, std::string folder, const std::function<bool(const TileKey&)>& is_made);

    /// To be called once for each tile that is_made denied. Threads may call it at once. Throws Error as dropArrays.
    void tileIsMade(const TileKey& tile);

private:
    const TileTree& tree_;
    const std::string folder_;
    std::mutex mutex_;
    std::map<TileKey, std::size_t> left_; ///< tiles that read it and are not made
};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Frees the disk space of splat files whose tiles are made.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// Counts the tiles still to be made from each splat file. Summaries stay, for levels and set.json.
class SplatReaders {
public:
    /// Drops arrays that are no longer needed. Throws Error as dropArrays.
    /// @param folder of the splat files; must have all of the tree's, including merged levels
    /// @param is_made whether a tile is made already
    SplatReaders(const TileTree& tree, std::string folder, const std::function<bool(const TileKey&)>& is_made);

    /// To be called once for each tile that was not made before. Thread-safe. Throws Error as dropArrays.
    void tileIsMade(const TileKey& tile);

private:
    const TileTree& tree_;
    const std::string folder_;
    std::mutex mutex_;
    std::map<TileKey, std::size_t> left_; ///< tiles that read it and are not made yet
};

} // namespace pointrt

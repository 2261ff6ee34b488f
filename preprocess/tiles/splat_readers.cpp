// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/splat_readers.h"

#include <utility>
#include <vector>

#include "preprocess/tiles/build_tile.h"
#include "preprocess/tiles/splat_file.h"

namespace pointrt {

SplatReaders::SplatReaders(const TileTree& tree, std::string folder, const std::function<bool(const TileKey&)>& is_made)
    : tree_(tree), folder_(std::move(folder)) {
    for (const TileKey& tile : tree.tiles()) {
        left_.try_emplace(tile, 0);
        if (is_made(tile)) continue;
        for (const TileKey& source : inputTilesOf(tree, tile)) ++left_[source];
    }
    for (const auto& [source, left] : left_)
        if (left == 0) dropArrays(folder_, source);
}

void SplatReaders::tileIsMade(const TileKey& tile) {
    std::vector<TileKey> done;
    {
        const std::lock_guard lock(mutex_);
        for (const TileKey& source : inputTilesOf(tree_, tile))
            if (--left_.at(source) == 0) done.push_back(source);
    }
    for (const TileKey& source : done) dropArrays(folder_, source);
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/make_tiles.h"

#include <cmath>
#include <memory>

#include "format/base/error.h"
#include "preprocess/tiles/bake_block.h"
#include "preprocess/tiles/finish_set.h"
#include "preprocess/tiles/merge_tile.h"
#include "preprocess/tiles/splat_file.h"
#include "preprocess/tiles/splat_readers.h"
#include "preprocess/tiles/tile_scheduler.h"
#include "preprocess/tiles/widest_radius.h"

namespace pointrt {

namespace {

std::uint64_t splatsIn(const std::string& folder, const std::vector<TileKey>& tiles) {
    std::uint64_t splats = 0;
    for (const TileKey& tile : tiles) splats += readSplatSummary(folder, tile).head.count;
    return splats;
}

/// Data of the whole set that building tiles needs.
struct TileMaker {
    TileSet set;
    TileTree tree;
    SetFolders folders;
    std::vector<LevelCoding> codings;
    TileOptions options;
    mutable PointBudget budget;
    std::unique_ptr<SplatReaders> readers; ///< only if splats are dropped

    TileMaker(const SetPlan& plan, const std::string& metadata, std::size_t threads)
        : set(latticeOf(plan)), tree(treeOf(plan)), folders{plan.output, splatsFolder(plan)},
          budget(mostPointsAtOnce(plan.bake.max_memory)) {
        options = {plan.bake.octree, plan.bake.prune,          plan.bake.pruning,      plan.bake.index,
                   threads,          widestRadius(plan, tree), plan.bake.reflectivity, metadata};
        codings = readLevelCodings(tree, set.edge, folders.splats, options.widest);
        makeFolder(folders.set + "/tiles");
        if (plan.bake.drop_work)
            readers = std::make_unique<SplatReaders>(
                tree, folders.splats, [&](const TileKey& tile) { return findTileRow(folders, tile).has_value(); });
    }

    std::optional<SetTile> make(const TileKey& tile) const {
        if (auto row = findTileRow(folders, tile)) return row;
        const PointBudget::Reservation reservation =
            budget.reserve(2 * splatsIn(folders.splats, {tile})); // neighbours add the same number again
        auto row = buildTile(set, tree, tile, codings, folders, options);
        if (readers) readers->tileIsMade(tile);
        return row;
    }
};

/// Merged tiles of a level.
std::vector<TileKey> mergedTiles(const TileTree& tree, std::uint32_t level) {
    std::vector<TileKey> merged;
    for (const TileKey& tile : tree.tiles())
        if (tile.level == level && !tree.isOriginal(tile)) merged.push_back(tile);
    return merged;
}

} // namespace

void mergeLevels(const SetPlan& plan, std::uint64_t tile_splats, std::size_t threads, const StageProgress& progress) {
    const TileTree tree = treeOf(plan);
    const TileSet set = latticeOf(plan);
    const std::string folder = splatsFolder(plan);
    const float widest = widestRadius(plan, tree);
    PointBudget budget(mostPointsAtOnce(plan.bake.max_memory));
    for (std::uint32_t level = 1; level <= tree.root().level; ++level) { // children first
        const std::vector<TileKey> merged = mergedTiles(tree, level);
        forTiles(merged.size(), threads, "levels", {}, [&](std::size_t k) {
            if (hasSplatFile(folder, merged[k])) return;
            const std::vector<TileKey> children = tree.childrenOf(merged[k]);
            const PointBudget::Reservation reservation = budget.reserve(splatsIn(folder, children));
            mergeTile(folder, merged[k], children, edgeOf(set, level), tile_splats, set.oriented, widest);
        });
        // each level leaves a quarter of the splats
        if (progress) progress("levels", 1 - std::pow(0.25, level));
    }
}

void makeBlockTiles(const SetPlan& plan, BlockRange blocks, const std::string& metadata, std::size_t threads,
                    const StageProgress& progress) {
    const TileMaker maker(plan, metadata, threads);
    const TileRange range = tilesOf(plan, blocks);
    forTiles(range.end - range.first, threads, "tiles", progress,
             [&](std::size_t k) { maker.make(keyOf(plan.tiles[range.first + k])); });
}

TileSet makeSet(const SetPlan& plan, const std::string& metadata, std::size_t threads, const StageProgress& progress) {
    TileMaker maker(plan, metadata, threads);
    const std::vector<TileKey>& tiles = maker.tree.tiles();
    std::vector<std::optional<SetTile>> made(tiles.size());
    forTiles(tiles.size(), threads, "tiles", progress, [&](std::size_t k) { made[k] = maker.make(tiles[k]); });
    std::vector<SetTile> rows;
    for (const std::optional<SetTile>& row : made)
        if (row) rows.push_back(*row);
    if (rows.empty()) throw Error(ExitCode::kBadInput, plan.output + ": no tile has a splat");
    finishSet(maker.set, maker.tree, maker.codings, std::move(rows), maker.folders);
    return maker.set;
}

} // namespace pointrt

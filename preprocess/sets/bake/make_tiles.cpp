// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/sets/bake/make_tiles.h"

#include <filesystem>

#include "format/base/error.h"
#include "preprocess/merge/merge_tile.h"
#include "preprocess/sets/bake/bake_block.h"
#include "preprocess/tiles/finish_set.h"

namespace pointrt {

namespace {

/// What building tiles needs to know of the whole set.
struct TileMaker {
    TileSet set;
    TileTree tree;
    SetFolders folders;
    std::vector<LevelCoding> codings;
    TileOptions options;

    TileMaker(const SetPlan& plan, const std::string& metadata, std::size_t threads)
        : set(latticeOf(plan)), tree(treeOf(plan)), folders{plan.output, splatsFolder(plan)},
          codings(readLevelCodings(tree, set.edge, folders.splats)) {
        options = {plan.bake.octree, plan.bake.prune,        plan.bake.pruning, plan.bake.index,
                   threads,          plan.bake.reflectivity, metadata};
        std::filesystem::create_directories(folders.set + "/tiles");
    }

    std::optional<SetTile> make(const TileKey& tile) const {
        if (auto row = findTileRow(folders, tile)) return row;
        return buildTile(set, tree, tile, codings, folders, options);
    }
};

} // namespace

void mergeLevels(const SetPlan& plan, std::uint64_t tile_splats, const StageProgress& progress) {
    const TileTree tree = treeOf(plan);
    const TileSet set = latticeOf(plan);
    const std::string folder = splatsFolder(plan);
    const std::vector<TileKey>& tiles = tree.tiles(); // parents first
    std::size_t done = 0;
    for (auto tile = tiles.rbegin(); tile != tiles.rend(); ++tile) {
        if (!tree.isOriginal(*tile) && !hasSplatFile(folder, *tile))
            mergeTile(folder, *tile, tree.childrenOf(*tile), edgeOf(set, tile->level), tile_splats, set.oriented);
        if (progress) progress("levels", double(++done) / double(tiles.size()));
    }
}

void makeBlockTiles(const SetPlan& plan, BlockRange blocks, const std::string& metadata, std::size_t threads,
                    const StageProgress& progress) {
    const TileMaker maker(plan, metadata, threads);
    const std::uint32_t first = plan.first_tile_of_block.at(blocks.first),
                        end = plan.first_tile_of_block.at(blocks.end);
    for (std::uint32_t number = first; number < end; ++number) {
        maker.make(keyOf(plan.tiles[number]));
        if (progress) progress("tiles", double(number + 1 - first) / double(end - first));
    }
}

TileSet makeSet(const SetPlan& plan, const std::string& metadata, std::size_t threads, const StageProgress& progress) {
    TileMaker maker(plan, metadata, threads);
    std::vector<SetTile> rows;
    for (const TileKey& tile : maker.tree.tiles()) {
        if (const auto row = maker.make(tile)) rows.push_back(*row);
        if (progress) progress("tiles", double(rows.size()) / double(maker.tree.tiles().size()));
    }
    if (rows.empty()) throw Error(ExitCode::kBadInput, plan.output + ": no tile has a splat");
    finishSet(maker.set, maker.tree, maker.codings, std::move(rows), maker.folders);
    return maker.set;
}

} // namespace pointrt

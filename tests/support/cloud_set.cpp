// SPDX-License-Identifier: Apache-2.0
#include "tests/support/cloud_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "preprocess/cloud/bounds.h"
#include "preprocess/tiles/finish_set.h"
#include "preprocess/tiles/merge_tile.h"
#include "preprocess/tiles/select_splats.h"

namespace pointrt::test {
namespace {

TileSet latticeOf(const Splats& splats, const CloudSetOptions& options) {
    const surface::Bounds bounds = surface::boundsOf(splats.positions);
    TileSet set;
    set.edge = options.edge;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        set.lattice_origin[a] = std::floor((splats.origin[axis] + bounds.low[axis]) / set.edge) * set.edge;
        set.up[a] = options.world.up[axis];
    }
    set.metres = options.world.metres_per_unit;
    set.crs = options.world.crs;
    set.input_points = splats.input_count;
    set.oriented = splats.oriented;
    for (std::size_t i = 0; i + 4 <= options.sensors.size(); i += 4)
        set.sensors.push_back(
            {options.sensors[i], options.sensors[i + 1], options.sensors[i + 2], options.sensors[i + 3]});
    return set;
}

TileCell cellOf(const TileSet& set, const Vec3d& position) {
    TileCell cell;
    for (int axis = 0; axis < 3; ++axis)
        cell[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(
            std::floor((position[axis] - set.lattice_origin[static_cast<std::size_t>(axis)]) / set.edge));
    return cell;
}

std::vector<TileKey> cellsOf(const TileSet& set, const Splats& splats) {
    std::set<TileCell> cells;
    for (const Vec3f& position : splats.positions) cells.insert(cellOf(set, splats.origin + position.cast<double>()));
    std::vector<TileKey> tiles;
    for (const TileCell& cell : cells) tiles.push_back({0, cell});
    return tiles;
}

void writeOriginals(const CloudSet& made, const Splats& splats, const std::vector<Attribute>& attributes) {
    for (const TileKey& tile : made.tree.tiles()) {
        if (!made.tree.isOriginal(tile)) continue;
        const std::vector<PositionCode> codes = codesOf(made.set, tile, splats);
        std::vector<std::uint8_t> kept(codes.size());
        std::transform(codes.begin(), codes.end(), kept.begin(), [](const auto& code) { return isInCore(code); });
        writeSplats(made.folders.splats, tile, selectSplats(splats, attributes, codes, kept, made.set.edge));
    }
}

void writeMerged(const CloudSet& made, const CloudSetOptions& options) {
    const std::vector<TileKey>& tiles = made.tree.tiles(); // parents come first
    for (auto tile = tiles.rbegin(); tile != tiles.rend(); ++tile)
        if (!made.tree.isOriginal(*tile))
            mergeTile(made.folders.splats, *tile, made.tree.childrenOf(*tile), edgeOf(made.set, tile->level),
                      options.tile_splats, made.set.oriented);
}

} // namespace

CloudSet writeCloudSet(const std::string& folder, const Splats& splats, const std::vector<Attribute>& attributes,
                       const CloudSetOptions& options) {
    const TileSet lattice = latticeOf(splats, options);
    CloudSet made{lattice, TileTree(cellsOf(lattice, splats)), {folder, folder + ".splats"}};
    for (const std::string& each : {made.folders.splats, folder + "/tiles"}) std::filesystem::create_directories(each);
    writeOriginals(made, splats, attributes);
    writeMerged(made, options);
    const std::vector<LevelCoding> codings = readLevelCodings(made.tree, made.set.edge, made.folders.splats);
    std::vector<SetTile> rows;
    for (const TileKey& tile : made.tree.tiles())
        if (const auto row = buildTile(made.set, made.tree, tile, codings, made.folders, options.tiles))
            rows.push_back(*row);
    finishSet(made.set, made.tree, codings, std::move(rows), made.folders);
    return made;
}

double edgeForTiles(const Splats& splats, std::size_t tiles) {
    CloudSetOptions options;
    const double extent = surface::boundsOf(splats.positions).longestEdge();
    options.edge = std::exp2(std::ceil(std::log2(extent)));
    double best = options.edge, miss = std::numeric_limits<double>::infinity();
    for (int halvings = 0; halvings < 16; ++halvings, options.edge /= 2) {
        const auto count = static_cast<double>(cellsOf(latticeOf(splats, options), splats).size());
        const double factor = std::abs(std::log(count / static_cast<double>(tiles)));
        if (factor < miss) best = options.edge;
        miss = std::min(miss, factor);
        if (count > 4 * static_cast<double>(tiles)) break;
    }
    return best;
}

} // namespace pointrt::test

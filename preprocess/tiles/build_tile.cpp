// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/build_tile.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "preprocess/octree/file_index.h"
#include "preprocess/octree/splat_attributes.h"
#include "preprocess/octree/write.h"
#include "preprocess/tiles/collect_splats.h"
#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/pack_tile.h"
#include "preprocess/tiles/splat_file.h"

namespace pointrt {

namespace {

using OrderedJson = nlohmann::ordered_json;

CollectedSplats gatherAll(const TileSet& set, const TileTree& tree, const TileKey& tile, const std::string& folder,
                          float widest) {
    CollectedSplats gathered;
    if (readSplatSummary(folder, tile).head.count == 0)
        return gathered; // splats that cleaning moved here have no parent either
    const double edge = edgeOf(set, tile.level);
    for (const TileKey& source : inputTilesOf(tree, tile)) {
        const SplatFile file(folder, source, widest);
        if (source != tile && holdsGaussians(file.schema())) continue; // nor copies of its neighbours' Gaussians
        if (gathered.splats.attributes.empty()) gathered.splats.attributes = file.schema();
        if (gathered.splats.attributes.size() != file.schema().size())
            throw Error(ExitCode::kBadInput,
                        splatFileOf(folder, source) + ": its attributes differ from its neighbours'");
        collectSplats(tile, edge, source, file.splats(), gathered);
        if (source != tile) continue;
        gathered.splats.error = file.head().error;
        gathered.splats.spacing = file.head().spacing;
    }
    return gathered;
}

std::string metadataOf(const TileOptions& options, const TileKey& tile, const CollectedSplats& gathered) {
    OrderedJson json = OrderedJson::parse(options.metadata);
    json["tile"] = {{"level", tile.level},
                    {"cell", tile.cell},
                    {"splats", gathered.own},
                    {"error", gathered.splats.error},
                    {"spacing", gathered.splats.spacing}};
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

ProContent contentOf(const TileSet& set, const TileOptions& options, const TileKey& tile, CollectedSplats& gathered,
                     const PackedSplats& packed) {
    ProContent content;
    content.materials = {scanMaterial((packed.frame.flags & PRO_FLAG_COLOR) != 0, options.reflectivity)};
    content.attributes = gatherAttributes(gathered.splats.attributes, packed.input_index);
    for (const auto& row : set.sensors) content.sensors.insert(content.sensors.end(), row.begin(), row.end());
    content.world.up = Vec3d(set.up[0], set.up[1], set.up[2]);
    content.world.metres_per_unit = set.metres;
    content.metadata = metadataOf(options, tile, gathered);
    content.pruned = options.prune;
    return content;
}

/// Gaussians as they are, in an octree of their own.
void writeGaussians(const std::string& path, const TileSet& set, const TileKey& tile, const TileOptions& options,
                    CollectedSplats& gathered, PackedSplats& packed) {
    const GaussianCloud cloud = takeGaussians(set, tile, gathered.splats);
    const GaussianSections gaussians = packGaussians(cloud, packed);
    ProContent content = contentOf(set, options, tile, gathered, packed);
    content.pruned = false;
    const Octree octree = buildCenterOctree(packed);
    ProSections sections = makeSections(packed, octree, content);
    sections.view.order = nullptr; // points are not numbered in a set
    writePro(path, true, sections, nullptr, &gaussians.view);
}

Octree growOctree(const PackedSplats& packed, const TileOptions& options) {
    Octree octree = buildOctree(packed, options.octree);
    if (options.prune) pruneOctree(packed, options.pruning, octree);
    return octree;
}

void write(const std::string& path, const PackedSplats& packed, const Octree& octree, const ProContent& content,
           const TileOptions& options) {
    ProSections sections = makeSections(packed, octree, content);
    sections.view.order = nullptr; // points are not numbered in a set
    TracingIndex index;
    pro_index index_view{};
    if (options.index) {
        index = fileIndex(sections, {options.threads, {}}, path, "--compact writes tiles without it");
        index_view = indexView(index);
    }
    writePro(path, true, sections, options.index ? &index_view : nullptr);
}

std::string pathOf(const SetFolders& folders, const TileKey& tile) {
    return folders.set + "/" + tileFileName(tile.level, tile.cell);
}

} // namespace

std::vector<TileKey> inputTilesOf(const TileTree& tree, const TileKey& tile) {
    std::vector<TileKey> sources = tree.neighborsOf(tile);
    sources.push_back(tile);
    std::sort(sources.begin(), sources.end());
    return sources;
}

std::optional<SetTile> buildTile(const TileSet& set, const TileTree& tree, const TileKey& tile,
                                 const std::vector<LevelCoding>& codings, const SetFolders& folders,
                                 const TileOptions& options) {
    CollectedSplats gathered = gatherAll(set, tree, tile, folders.splats, options.widest);
    if (gathered.own == 0) return std::nullopt;
    PackedSplats packed = packTile(set, tile, codings.at(tile.level), gathered.splats);
    if (holdsGaussians(gathered.splats.attributes)) {
        writeGaussians(pathOf(folders, tile), set, tile, options, gathered, packed);
        return findTileRow(folders, tile);
    }
    const ProContent content = contentOf(set, options, tile, gathered, packed);
    gathered = {};
    const Octree octree = growOctree(packed, options);
    freeBuildData(packed);
    write(pathOf(folders, tile), packed, octree, content, options);
    return findTileRow(folders, tile);
}

} // namespace pointrt

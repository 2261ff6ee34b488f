// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_source.h"

#include <algorithm>

#include "format/points/input_order.h"
#include "format/points/metadata.h"
#include "format/points/pro_points.h"
#include "format/set/open_tile.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;

/// Whether the splat's centre lies in the middle half of the cube on each axis, which is the core.
bool isInCore(const pro_splat& splat) {
    return std::all_of(std::begin(splat.position), std::end(splat.position),
                       [](float axis) { return axis >= 0.25f && axis < 0.75f; });
}

std::vector<std::uint32_t> coreSplats(const ProFile& tile) {
    std::vector<std::uint32_t> splats = inputOrder(tile);
    std::erase_if(splats, [&](std::uint32_t splat) { return !isInCore(tile.splat(splat)); });
    return splats;
}

/// The tile's, with the coordinate system where only set.json has it.
std::string metadataOf(const TileSet& set, const ProFile& tile) {
    Json json = parseMetadata(tile.metadata());
    if (!json.is_object()) json = Json::object();
    if (!json.contains("world")) json["world"] = {{"crs", set.crs}};
    return dumpJson(json, false);
}

void forEachTile(const TileSet& set, const std::string& folder, const UseSplats& use) {
    for (const SetTile& tile : set.tiles) {
        if (!tile.isOriginal()) continue;
        const ProFile file = openTile(set, tile, folder, PRO_OPEN_SKIP_CHECKSUMS);
        use(file, coreSplats(file));
    }
}

/// From the first tile with original splats, and what the whole set has.
PointOutline outlineOf(const TileSet& set, const std::string& folder) {
    const auto first =
        std::find_if(set.tiles.begin(), set.tiles.end(), [](const auto& tile) { return tile.isOriginal(); });
    const ProFile file = openTile(set, *first, folder, PRO_OPEN_SKIP_CHECKSUMS);
    PointOutline outline = outlineOf(file);
    outline.position_step = 2 * set.edge / PRO_POSITION_STEPS;
    outline.bounds_min = set.bounds_min;
    outline.bounds_max = set.bounds_max;
    outline.metres_per_unit = set.metres;
    outline.metadata = metadataOf(set, file);
    const std::size_t own = outline.columns.size() - set.attributes.size(); // normals and so on stand first
    for (std::size_t i = 0; i < set.attributes.size(); ++i) {
        outline.columns[own + i].range = {{set.attributes[i].low, set.attributes[i].high}};
        outline.columns[own + i].values = nullptr;
    }
    return outline;
}

} // namespace

ExportSource exportSource(const ProFile& file) {
    const std::vector<std::uint32_t> splats = inputOrder(file);
    ExportSource source{outlineOf(file), [&file, splats](const UseSplats& use) { use(file, splats); }};
    source.outline.count = splats.size();
    return source;
}

ExportSource exportSource(const TileSet& set, const std::string& folder) {
    ExportSource source{outlineOf(set, folder), [set, folder](const UseSplats& use) { forEachTile(set, folder, use); }};
    std::uint64_t count = 0;
    source.forEachPart([&](const ProFile&, std::span<const std::uint32_t> splats) { count += splats.size(); });
    source.outline.count = count;
    return source;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_source.h"

#include <algorithm>

#include "format/info/input_order.h"
#include "format/info/metadata.h"
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

bool forEachTile(const TileSet& set, const std::string& folder, const UseSplats& use) {
    for (const SetTile& tile : set.tiles) {
        if (!tile.isOriginal()) continue;
        const ProFile file = openTile(set, tile, folder, PRO_OPEN_SKIP_CHECKSUMS);
        if (!use(file, coreSplats(file))) return false;
    }
    return true;
}

/// From the first tile with original splats, and what the whole set has.
void describe(const TileSet& set, const std::string& folder, ExportSource& source) {
    const auto first =
        std::find_if(set.tiles.begin(), set.tiles.end(), [](const auto& tile) { return tile.isOriginal(); });
    const ProFile file = openTile(set, *first, folder, PRO_OPEN_SKIP_CHECKSUMS);
    source.info = file.info();
    source.info.scale = 2 * set.edge;
    std::copy(set.bounds_min.begin(), set.bounds_min.end(), source.info.bounds_min);
    std::copy(set.bounds_max.begin(), set.bounds_max.end(), source.info.bounds_max);
    source.world.metres_per_unit = set.metres;
    source.attributes = file.attributes();
    for (std::size_t i = 0; i < source.attributes.size(); ++i) {
        source.attributes[i].low = set.attributes[i].low;
        source.attributes[i].high = set.attributes[i].high;
        source.attributes[i].values = nullptr;
    }
    source.metadata = metadataOf(set, file);
}

} // namespace

ExportSource exportSource(const ProFile& file) {
    ExportSource source{file.info(), file.world(), file.attributes(), std::string(file.metadata()), 0, {}};
    const std::vector<std::uint32_t> splats = inputOrder(file);
    source.splats = splats.size();
    source.forEachPart = [&file, splats](const UseSplats& use) { return use(file, splats); };
    return source;
}

ExportSource exportSource(const TileSet& set, const std::string& folder) {
    ExportSource source;
    describe(set, folder, source);
    source.forEachPart = [set, folder](const UseSplats& use) { return forEachTile(set, folder, use); };
    source.forEachPart([&](const ProFile&, std::span<const std::uint32_t> splats) {
        source.splats += splats.size();
        return true;
    });
    return source;
}

} // namespace pointrt

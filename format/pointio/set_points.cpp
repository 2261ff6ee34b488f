// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/set_points.h"

#include <algorithm>

#include "format/pointio/input_order.h"
#include "format/pointio/metadata.h"
#include "format/pointio/pro_points.h"
#include "format/set/core_splats.h"
#include "format/set/open_tile.h"

namespace pointrt {
namespace {

using Json = nlohmann::ordered_json;

/// The metadata of a tile, with the coordinate system of set.json if it has none.
std::string metadataOf(const TileSet& set, const ProFile& tile) {
    Json json = parseMetadata(tile.metadata());
    if (!json.is_object()) json = Json::object();
    if (!json.contains("world")) json["world"] = {{"crs", set.crs}};
    return dumpJson(json, false);
}

} // namespace

PointOutline outlineOf(const TileSet& set, const std::string& folder) {
    const auto first =
        std::find_if(set.tiles.begin(), set.tiles.end(), [](const auto& tile) { return tile.isOriginal(); });
    const ProFile file = openTile(set, *first, folder, PRO_OPEN_SKIP_CHECKSUMS);
    PointOutline outline = outlineOf(file);
    outline.count = set.splats;
    outline.position_step = 2 * set.edge / PRO_POSITION_STEPS;
    outline.bounds_min = set.bounds_min;
    outline.bounds_max = set.bounds_max;
    outline.metres_per_unit = set.metres;
    outline.metadata = metadataOf(set, file);
    const std::size_t own = outline.columns.size() - set.attributes.size(); // normals, radii and colours come first
    for (std::size_t i = 0; i < set.attributes.size(); ++i) {
        outline.columns[own + i].range = {{set.attributes[i].low, set.attributes[i].high}};
        outline.columns[own + i].values = nullptr;
    }
    return outline;
}

std::vector<std::uint32_t> coreNumbers(const ProFile& tile) {
    std::vector<std::uint32_t> splats = inputOrder(tile);
    std::erase_if(splats, [&](std::uint32_t splat) { return !isInCore(tile.splat(splat)); });
    return splats;
}

} // namespace pointrt

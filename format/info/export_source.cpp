// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_source.h"

#include "format/pointio/input_order.h"
#include "format/pointio/pro_points.h"
#include "format/pointio/set_points.h"
#include "format/set/open_tile.h"

namespace pointrt {

namespace {

void forEachTile(const TileSet& set, const std::string& folder, const UseSplats& use) {
    for (const SetTile& tile : set.tiles) {
        if (!tile.isOriginal()) continue;
        const ProFile file = openTile(set, tile, folder, PRO_OPEN_SKIP_CHECKSUMS);
        use(file, coreNumbers(file));
    }
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

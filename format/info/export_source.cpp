// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_source.h"

#include <algorithm>

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

/// Takes from a file the properties that set.json does not have.
void addFile(const ProFile& file, ExportSource& source) {
    if (!file.gaussians()) return;
    source.has_gaussians = true;
    source.harmonics_degree = std::max(source.harmonics_degree, file.gaussians()->degree);
    std::copy_n(file.world().up, source.up.size(), source.up.begin());
}

} // namespace

ExportSource exportSource(const ProFile& file) {
    const std::vector<std::uint32_t> splats = inputOrder(file);
    ExportSource source;
    source.outline = outlineOf(file);
    source.outline.count = splats.size();
    source.forEachPart = [&file, splats](const UseSplats& use) { use(file, splats); };
    addFile(file, source);
    return source;
}

ExportSource exportSource(const TileSet& set, const std::string& folder) {
    ExportSource source;
    source.outline = outlineOf(set, folder);
    source.forEachPart = [set, folder](const UseSplats& use) { forEachTile(set, folder, use); };
    std::uint64_t count = 0;
    source.forEachPart([&](const ProFile& file, std::span<const std::uint32_t> splats) {
        count += splats.size();
        addFile(file, source);
    });
    source.outline.count = count;
    return source;
}

} // namespace pointrt

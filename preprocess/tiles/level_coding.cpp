// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/level_coding.h"

#include <algorithm>
#include <cmath>

#include "preprocess/octree/quantize.h"

namespace pointrt {

namespace {

void widen(RadiusRange& range, const RadiusRange& other) {
    if (other.most <= 0) return;
    range.least = range.most > 0 ? std::min(range.least, other.least) : other.least;
    range.most = std::max(range.most, other.most);
}

} // namespace

std::vector<LevelCoding> findLevelCodings(const TileTree& tree, double edge,
                                          const std::function<RadiusRange(const TileKey&)>& range_of) {
    std::vector<RadiusRange> ranges(tree.root().level + 1);
    for (const TileKey& tile : tree.tiles()) {
        widen(ranges[tile.level], range_of(tile));
        for (const TileKey& beside : tree.neighborsOf(tile))
            if (beside.level != tile.level) widen(ranges[tile.level], range_of(beside));
    }
    std::vector<LevelCoding> codings;
    for (std::size_t level = 0; level < ranges.size(); ++level) {
        const double edge_here = std::ldexp(edge, static_cast<int>(level));
        const float limit = static_cast<float>(kRadiusPerEdge * edge_here);
        const float most = std::min(ranges[level].most, limit), least = std::min(ranges[level].least, most);
        codings.emplace_back();
        if (!(most > 0)) continue;
        const RadiusCoding coding = radiusCoding(least, most);
        codings.back() = {static_cast<float>(std::min(coding.max, limit) / (2 * edge_here)), coding.step};
    }
    return codings;
}

} // namespace pointrt

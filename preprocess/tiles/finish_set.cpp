// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/finish_set.h"

#include <algorithm>
#include <limits>

#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/splat_file.h"

namespace pointrt {

namespace {

/// Combined statistics of the original tiles' files.
class OriginalSums {
public:
    void add(const TileSet& set, const TileKey& tile, const SplatFileSummary& summary) {
        const SplatFileHead& head = summary.head;
        if (attributes_.empty()) attributes_ = summary.attributes;
        if (head.count == 0) return;
        low_ = low_.cwiseMin(positionOf(set, tile, head.lowest));
        high_ = high_.cwiseMax(positionOf(set, tile, head.highest));
        noise_.push_back({head.noise, head.count});
        colors_ = colors_ || head.has_colors;
        for (std::size_t a = 0; a < attributes_.size() && a < summary.attributes.size(); ++a) {
            SetAttribute& all = attributes_[a];
            const SetAttribute& one = summary.attributes[a];
            all.low = counted_ ? std::min(all.low, one.low) : one.low;
            all.high = counted_ ? std::max(all.high, one.high) : one.high;
        }
        counted_ = true;
    }

    void fill(TileSet& set) {
        for (int axis = 0; axis < 3; ++axis) {
            set.bounds_min[static_cast<std::size_t>(axis)] = low_[axis];
            set.bounds_max[static_cast<std::size_t>(axis)] = high_[axis];
        }
        set.colors = colors_;
        set.noise = median();
        std::erase_if(attributes_, [](const SetAttribute& each) {
            return isGaussianAttribute(each.name) || each.name == kGaussianFraction;
        });
        set.attributes = attributes_;
    }

private:
    struct Noise {
        float median;
        std::uint64_t splats;
    };

    double median() {
        std::sort(noise_.begin(), noise_.end(), [](const auto& a, const auto& b) { return a.median < b.median; });
        std::uint64_t all = 0, below = 0;
        for (const Noise& each : noise_) all += each.splats;
        for (const Noise& each : noise_)
            if (2 * (below += each.splats) > all) return each.median;
        return 0;
    }

    Vec3d low_ = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d high_ = Vec3d::Constant(-std::numeric_limits<double>::infinity());
    std::vector<Noise> noise_;
    std::vector<SetAttribute> attributes_;
    bool colors_ = false, counted_ = false;
};

} // namespace

std::vector<LevelCoding> readLevelCodings(const TileTree& tree, double edge, const std::string& splats_folder,
                                          float widest) {
    std::map<TileKey, RadiusRange> ranges;
    for (const TileKey& tile : tree.tiles()) {
        const SplatFileHead head = readSplatSummary(splats_folder, tile).head;
        const float limit = tree.isOriginal(tile) ? widest : std::numeric_limits<float>::infinity();
        ranges[tile] = {std::min(head.radius_min, limit), std::min(head.radius_max, limit)};
    }
    return findLevelCodings(tree, edge, [&](const TileKey& tile) { return ranges.at(tile); });
}

void finishSet(TileSet& set, const TileTree& tree, const std::vector<LevelCoding>& codings, std::vector<SetTile> rows,
               const SetFolders& folders) {
    OriginalSums sums;
    for (const TileKey& tile : tree.tiles())
        if (tree.isOriginal(tile)) sums.add(set, tile, readSplatSummary(folders.splats, tile));
    sums.fill(set);
    set.levels.assign(codings.size(), {});
    for (std::size_t level = 0; level < codings.size(); ++level) {
        set.levels[level].radius_max = double{codings[level].radius_max};
        set.levels[level].radius_step = double{codings[level].radius_step};
    }
    set.tiles = std::move(rows);
    arrangeTiles(set);
    writeTileSet(set, folders.set);
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pointrt {

namespace {

/// Most discs of a region: few enough for a uniform density, and enough that one more cell along an edge changes
/// little: regions of 256 to 1024 discs on a surface have 6 to 13 cells along an edge.
constexpr std::size_t kRegionDiscs = 1024;
/// Most halvings of the cube into regions, which are then as small as a step of position codes.
constexpr int kDepthMax = 20;
/// A plane intersects this many cells of edge 1 per unit of area, averaged over directions.
constexpr double kCellsPerArea = 1.5;
/// Most cells along an edge; on a surface, fewer are enough for a single disc in each.
constexpr std::uint32_t kCellsMax = 128;

struct Region {
    Vec3f low;
    float edge;
    std::uint32_t begin, end; ///< range of discs
};

int slotOf(const Vec3f& position, const Vec3f& middle) {
    return (position.x() >= middle.x()) | (position.y() >= middle.y()) << 1 | (position.z() >= middle.z()) << 2;
}

void splitRegion(const MergeDiscs& discs, const Region& region, int depth, std::vector<Region>& regions) {
    if (region.begin == region.end) return;
    if (region.end - region.begin <= kRegionDiscs || depth == kDepthMax) return regions.push_back(region);
    const float half = region.edge / 2;
    const Vec3f middle = region.low.array() + half;
    std::uint32_t begin = region.begin;
    for (int slot = 0; slot < 8; ++slot) { // slots ascend along the curve
        const auto first = discs.positions.begin();
        const auto end = std::partition_point(first + begin, first + region.end,
                                              [&](const Vec3f& each) { return slotOf(each, middle) <= slot; });
        const auto last = static_cast<std::uint32_t>(end - first);
        const Vec3f low = region.low + half * Vec3f(float(slot & 1), float(slot >> 1 & 1), float(slot >> 2));
        splitRegion(discs, {low, half, begin, last}, depth + 1, regions);
        begin = last;
    }
}

/// Groups the discs of a region by cell and side, and splits long thin groups.
MergeGroups groupBy(const MergeDiscs& discs, const Region& region, std::uint32_t cells, bool oriented) {
    struct Placed {
        std::uint32_t cell, disc;
        bool operator<(const Placed& other) const { return cell != other.cell ? cell < other.cell : disc < other.disc; }
    };
    std::vector<Placed> placed;
    const float per_edge = static_cast<float>(cells) / region.edge;
    for (std::uint32_t i = region.begin; i < region.end; ++i) {
        const Vec3f place = (discs.positions[i] - region.low) * per_edge;
        const auto at = [&](int axis) {
            return static_cast<std::uint32_t>(std::clamp(place[axis], 0.0f, static_cast<float>(cells - 1)));
        };
        placed.push_back({(at(2) * cells + at(1)) * cells + at(0), i});
    }
    std::sort(placed.begin(), placed.end());

    MergeGroups groups;
    std::vector<std::uint32_t> members, sizes;
    for (std::size_t begin = 0, end; begin < placed.size(); begin = end) {
        members.clear();
        for (end = begin; end < placed.size() && placed[end].cell == placed[begin].cell; ++end)
            members.push_back(placed[end].disc);
        const std::vector<std::uint32_t> side_of = groupBySide(discs, members, oriented);
        const std::uint32_t sides = *std::max_element(side_of.begin(), side_of.end()) + 1;
        for (std::uint32_t side = 0; side < sides; ++side) {
            std::size_t first = groups.members.size();
            for (std::size_t k = 0; k < members.size(); ++k)
                if (side_of[k] == side) groups.members.push_back(members[k]);
            sizes.clear();
            splitLong(discs, std::span(groups.members).subspan(first), sizes);
            for (const std::uint32_t size : sizes) {
                groups.first.push_back(static_cast<std::uint32_t>(first));
                first += size;
            }
        }
    }
    return groups;
}

/// Ratio (at least 1) between a number of groups and the target.
double missOf(const MergeGroups& groups, double wanted) {
    const double ratio = static_cast<double>(groups.first.size()) / wanted;
    return std::max(ratio, 1 / ratio);
}

/// Groups the discs of a region into about share times their number. Searches for the number of cells along an edge:
/// starts with that of a plane, and goes up or down as long as the number of groups gets closer.
MergeGroups groupRegion(const MergeDiscs& discs, const Region& region, double share, bool oriented) {
    const double wanted = std::max(1.0, share * (region.end - region.begin));
    const auto guess = static_cast<std::uint32_t>(std::round(std::sqrt(wanted / kCellsPerArea)));
    std::uint32_t cells = std::clamp(guess, 1u, kCellsMax);
    MergeGroups best = groupBy(discs, region, cells, oriented);
    const bool more = static_cast<double>(best.first.size()) < wanted;
    while (more ? cells < kCellsMax : cells > 1) {
        cells = more ? cells + 1 : cells - 1;
        MergeGroups next = groupBy(discs, region, cells, oriented);
        if (missOf(next, wanted) >= missOf(best, wanted)) break;
        best = std::move(next);
    }
    return best;
}

} // namespace

MergeGroups findMergeGroups(const MergeDiscs& discs, double share, bool oriented) {
    std::vector<Region> regions;
    splitRegion(discs, {Vec3f::Zero(), 1, 0, static_cast<std::uint32_t>(discs.positions.size())}, 0, regions);
    std::vector<MergeGroups> of_regions(regions.size());
    tbb::parallel_for(std::size_t{0}, regions.size(),
                      [&](std::size_t r) { of_regions[r] = groupRegion(discs, regions[r], share, oriented); });
    MergeGroups all;
    for (const MergeGroups& each : of_regions) {
        const auto base = static_cast<std::uint32_t>(all.members.size());
        for (const std::uint32_t first : each.first) all.first.push_back(base + first);
        all.members.insert(all.members.end(), each.members.begin(), each.members.end());
    }
    all.first.push_back(static_cast<std::uint32_t>(all.members.size()));
    return all;
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_tile.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/merge_cells.h"
#include "preprocess/tiles/merge_gaussians.h"
#include "preprocess/tiles/merge_input.h"
#include "preprocess/tiles/merge_values.h"

namespace pointrt {

namespace {

/// The error that 95% of the area does not exceed, in units of the discs. The rest, strays and small fragments, would
/// force finer tiles without a visible difference.
double commonError(std::vector<MergedDisc> merged) {
    constexpr double kShare = 0.95;
    std::sort(merged.begin(), merged.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
    double area = 0, reached = 0;
    for (const MergedDisc& each : merged) area += double{each.radius} * each.radius;
    for (const MergedDisc& each : merged)
        if ((reached += double{each.radius} * each.radius) >= kShare * area) return each.error;
    return 0;
}

class Merger {
public:
    Merger(const TileKey& parent, const std::vector<MergeChild>& children, const std::vector<Attribute>& schema,
           double edge, double share, bool oriented)
        : input_(takeMergeInput(parent, children, edge)), groups_(findMergeGroups(input_.discs, share, oriented)),
          edge_(edge) {
        for (const MergeChild& child : children) views_.push_back(child.splats);
        discs_.resize(groups_.first.size() - 1);
        tbb::parallel_for(std::size_t{0}, discs_.size(),
                          [&](std::size_t g) { discs_[g] = mergeDiscs(input_.discs, membersOf(g), oriented); });
        sortGroups();
        for (const Attribute& each : schema) splats_.attributes.push_back({each.name, each.type, each.components, {}});
    }

    TileSplats merge() {
        const bool has_colors = std::any_of(views_.begin(), views_.end(), [](auto& v) { return !v.colors.empty(); });
        const bool has_noise = std::any_of(views_.begin(), views_.end(), [](auto& v) { return !v.noise.empty(); });
        const std::size_t count = discs_.size();
        splats_.positions.resize(count);
        splats_.normals.resize(count);
        splats_.radii.resize(count);
        splats_.colors.resize(has_colors ? count : 0);
        splats_.noise.resize(has_noise ? count : 0);
        for (Attribute& each : splats_.attributes) each.values.resize(count * each.bytesEach());
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) { fill(k); });
        splats_.spacing = spacingOf(splats_.positions, edge_ / kCoreSteps);
        const double step = edge_ / kCoreSteps; // half of it is lost by coding alone
        splats_.error = std::max({commonError(discs_) * edge_, splats_.spacing / 4, step});
        return std::move(splats_);
    }

private:
    std::span<const std::uint32_t> membersOf(std::size_t g) const {
        return std::span(groups_.members).subspan(groups_.first[g], groups_.first[g + 1] - groups_.first[g]);
    }

    /// Sorts along a Morton curve of the merged positions.
    void sortGroups() {
        for (std::uint32_t g = 0; g < discs_.size(); ++g) order_.push_back(g);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const std::uint64_t at_a = curveCode(discs_[a].position), at_b = curveCode(discs_[b].position);
            return at_a != at_b ? at_a < at_b : a < b;
        });
    }

    void fill(std::size_t k) {
        const MergedDisc& disc = discs_[order_[k]];
        splats_.positions[k] = codeAt(disc.position);
        splats_.normals[k] = normalWord(disc.normal);
        splats_.radii[k] = static_cast<float>(std::min(double{disc.radius}, kRadiusPerEdge) * edge_);
        std::vector<MergeSource> members;
        std::vector<float> areas;
        for (const std::uint32_t i : membersOf(order_[k])) {
            members.push_back(input_.sources[i]);
            areas.push_back(input_.discs.radii[i] * input_.discs.radii[i]);
        }
        const MergeGroup group{members, areas};
        if (!splats_.colors.empty()) splats_.colors[k] = meanColor(views_, group);
        if (!splats_.noise.empty()) splats_.noise[k] = meanNoise(views_, group);
        for (std::size_t a = 0; a < splats_.attributes.size(); ++a) {
            Attribute& to = splats_.attributes[a];
            mergeValue(views_, a, to, group, to.values.data() + k * to.bytesEach());
        }
    }

    MergeInput input_;
    MergeGroups groups_;
    double edge_;
    std::vector<SplatsView> views_;
    std::vector<MergedDisc> discs_;
    std::vector<std::uint32_t> order_;
    TileSplats splats_;
};

} // namespace

TileSplats mergeSplats(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                       double edge, std::uint64_t tile_splats, bool oriented) {
    std::sort(children.begin(), children.end(), [](const auto& a, const auto& b) { return a.tile < b.tile; });
    std::uint64_t count = 0;
    double error = 0;
    for (const MergeChild& child : children) {
        count += child.splats.positions.size();
        error = std::max(error, child.error);
    }
    const double share = std::min(kMergedShare, static_cast<double>(tile_splats) / static_cast<double>(count));
    TileSplats merged = Merger(parent, children, schema, edge, share, oriented).merge();
    merged.error += error;
    return merged;
}

void mergeTile(const std::string& folder, const TileKey& parent, const std::vector<TileKey>& children, double edge,
               std::uint64_t tile_splats, bool oriented, float widest) {
    std::vector<std::unique_ptr<SplatFile>> files;
    std::vector<MergeChild> merged;
    for (const TileKey& child : children) {
        files.push_back(std::make_unique<SplatFile>(folder, child, widest));
        merged.push_back({child, files.back()->splats(), files.back()->head().error});
    }
    const std::vector<Attribute>& schema = files.front()->schema();
    writeSplats(folder, parent,
                holdsGaussians(schema) ? mergeGaussians(parent, std::move(merged), schema, edge, tile_splats)
                                       : mergeSplats(parent, std::move(merged), schema, edge, tile_splats, oriented));
}

} // namespace pointrt

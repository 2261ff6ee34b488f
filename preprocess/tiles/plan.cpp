// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointrt {

double edgeOf(const SetPlan& plan, std::uint32_t level) { return std::ldexp(plan.edge, static_cast<int>(level)); }

std::uint64_t mostPointsAtOnce(std::uint64_t max_memory) {
    constexpr std::uint64_t kBytesPerPoint = 250, kProgram = 256 << 20;
    return std::max<std::uint64_t>(2000, (max_memory - std::min(max_memory, kProgram)) / kBytesPerPoint);
}

PlanBox coreOf(const SetPlan& plan, const PlanTile& tile) {
    const double edge = edgeOf(plan, tile.level);
    const Vec3d low = plan.lattice_origin + edge * Vec3d(tile.cell[0], tile.cell[1], tile.cell[2]);
    return {low, low + Vec3d::Constant(edge)};
}

double firstHalo(const SetPlan& plan, const PlanTile& tile) {
    // Five steps of neighbours of neighbours contribute to a normal (normals.cpp). 16 neighbours extend 2.3 spacings on
    // a surface, so five steps are 11.5; half as much again allows for uneven density.
    constexpr double kHaloSpacings = 16;
    const double widest = edgeOf(plan, tile.level) / 2;
    return tile.spacing > 0 ? std::min(kHaloSpacings * tile.spacing, widest) : widest;
}

std::string nameOf(const PlanTile& tile) {
    return fmt::format("{}-{}-{}-{}", tile.level, tile.cell[0], tile.cell[1], tile.cell[2]);
}

TileRange tilesOf(const SetPlan& plan, BlockRange blocks) {
    return {plan.first_tile_of_block.at(blocks.first), plan.first_tile_of_block.at(blocks.end)};
}

std::vector<std::uint32_t> tilesIn(const SetPlan& plan, const PlanBox& box) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const PlanBox core = coreOf(plan, plan.tiles[i]);
        const bool reaches = (core.min().array() <= box.max().array()).all() && // cores are half-open
                             (core.max().array() > box.min().array()).all();
        if (reaches) found.push_back(i);
    }
    return found;
}

std::string planFile(const std::string& work) { return work + "/plan.json"; }

std::string bucketsFolder(const SetPlan& plan) { return plan.work + "/buckets"; }

std::string bucketFile(const SetPlan& plan, const PlanTile& tile) {
    return bucketsFolder(plan) + "/" + nameOf(tile) + ".points";
}

std::string splitMark(const SetPlan& plan) { return plan.work + "/split.json"; }

std::string blocksMark(const SetPlan& plan) { return plan.work + "/blocks.json"; }

std::string levelsMark(const SetPlan& plan) { return plan.work + "/levels.json"; }

std::string splatsFolder(const SetPlan& plan) { return plan.work + "/splats"; }

std::string finishedFolder(const std::string& work) { return work + "/set"; }

} // namespace pointrt

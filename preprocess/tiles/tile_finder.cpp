// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/tile_finder.h"

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/morton.h"

namespace pointrt {
namespace {

bool isMultiple(const Vec3d& origin, double grid) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::trunc(origin[axis] / grid) != origin[axis] / grid) return false;
    return true;
}

} // namespace

TileFinder::TileFinder(const SetPlan& plan) : grid_(plan.edge), shift_(0) {
    for (; !isMultiple(plan.lattice_origin, grid_); ++shift_) grid_ /= 2;
    for (std::size_t axis = 0; axis < 3; ++axis)
        origin_[axis] = static_cast<std::int64_t>(plan.lattice_origin[Eigen::Index(axis)] / grid_);
    cells_ = std::int64_t{1} << (plan.levels - 1);
    for (const PlanTile& tile : plan.tiles) {
        const auto along = [&](std::size_t axis) { return static_cast<std::uint64_t>(tile.cell[axis]) << tile.level; };
        codes_.push_back(mortonCode(along(0), along(1), along(2)));
        spans_.push_back(std::uint64_t{1} << (3 * tile.level));
    }
}

std::uint32_t TileFinder::find(const Vec3d& position) const {
    constexpr double kMost = 0x1p60; // beyond any root
    std::array<std::uint64_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double steps = std::floor(position[Eigen::Index(axis)] / grid_);
        if (!(std::abs(steps) < kMost)) return kNone;
        const std::int64_t along = (static_cast<std::int64_t>(steps) - origin_[axis]) >> shift_;
        if (along < 0 || along >= cells_) return kNone;
        cell[axis] = static_cast<std::uint64_t>(along);
    }
    const std::uint64_t code = mortonCode(cell[0], cell[1], cell[2]);
    const auto after = std::upper_bound(codes_.begin(), codes_.end(), code);
    if (after == codes_.begin()) return kNone;
    const auto tile = static_cast<std::size_t>(after - codes_.begin()) - 1;
    return code - codes_[tile] < spans_[tile] ? static_cast<std::uint32_t>(tile) : kNone;
}

} // namespace pointrt

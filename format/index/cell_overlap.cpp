// SPDX-License-Identifier: Apache-2.0
#include "format/index/cell_overlap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "format/index/disc_section.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

/// Tests bounding boxes axis by axis for all cells, then planes and spheres for the remaining cells.
class BrickOverlap {
public:
    BrickOverlap(const CellDisc& disc, const Vector& offset, float slack) : disc_(disc), half_(0.5f + slack) {
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            for (std::uint32_t k = 0; k < PRO_BRICK_SIDE; ++k) {
                const float distance = disc.center[axis] - offset[axis] - (static_cast<float>(k) + 0.5f);
                const float outside = std::max(std::fabs(distance) - half_, 0.0f);
                along_[axis][k] = disc.normal[axis] * distance;
                distance_[axis][k] = distance;
                beyond_[axis][k] = outside * outside;
                outside_[axis][k] = outside;
            }
        widest_ = half_ * (std::fabs(disc.normal[0]) + std::fabs(disc.normal[1]) + std::fabs(disc.normal[2]));
    }

    CellSets cells() const {
        CellSets sets;
        const float slab = disc_.slab, radius_squared = disc_.radius * disc_.radius;
        const std::uint64_t disc_box = boxed(0.0f);
        for (std::uint64_t rest = boxed(slab); rest != 0; rest &= rest - 1) {
            const auto cell = static_cast<std::uint32_t>(std::countr_zero(rest));
            const std::uint32_t x = cell & 3, y = cell >> 2 & 3, z = cell >> 4;
            const float along = std::fabs(along_[0][x] + along_[1][y] + along_[2][z]);
            const float beyond = beyond_[0][x] + beyond_[1][y] + beyond_[2][z];
            const bool by_slab = along <= widest_ + slab && beyond <= radius_squared + slab * slab;
            const bool by_disc = (disc_box >> cell & 1) != 0 && along <= widest_ && beyond <= radius_squared;
            sets.by_slab |= std::uint64_t{by_slab} << cell;
            sets.by_disc |= std::uint64_t{by_disc && (beyond == 0 || overlaps(x, y, z))} << cell;
        }
        return sets;
    }

private:
    bool overlaps(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return overlapsCube({{distance_[0][x], distance_[1][y], distance_[2][z]}, disc_.normal, disc_.radius}, half_);
    }

    /// The cells that the bounding box overlaps: bits per axis, replicated along the other two.
    std::uint64_t boxed(float slab) const {
        constexpr std::uint64_t kAlong[3] = {0x1111111111111111u, 0x000F000F000F000Fu, 0x000000000000FFFFu};
        std::uint64_t all = ~std::uint64_t{0};
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const float reach = disc_.reach[axis] + slab * std::fabs(disc_.normal[axis]);
            std::uint64_t reached = 0;
            for (std::uint32_t k = 0; k < PRO_BRICK_SIDE; ++k)
                if (outside_[axis][k] <= reach) reached |= kAlong[axis] << (k << (PRO_BRICK_BITS * axis));
            all &= reached;
        }
        return all;
    }

    using PerCell = std::array<std::array<float, PRO_BRICK_SIDE>, 3>;
    const CellDisc& disc_;
    float half_, widest_ = 0;
    PerCell distance_, along_, beyond_, outside_;
};

} // namespace

bool mayOverlap(const CellDisc& disc, const CellBox& box, float slab) {
    const float half = box.half_edge + box.slack;
    float along = 0, widest = 0, beyond = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float offset = disc.center[axis] - box.middle[axis], normal = std::fabs(disc.normal[axis]);
        const float outside = std::max(std::fabs(offset) - half, 0.0f);
        if (outside > disc.reach[axis] + slab * normal) return false;
        along += disc.normal[axis] * offset;
        widest += normal;
        beyond += outside * outside;
    }
    return std::fabs(along) <= half * widest + slab && beyond <= disc.radius * disc.radius + slab * slab;
}

bool overlaps(const CellDisc& disc, const CellBox& box) {
    return mayOverlap(disc, box, 0.0f) && overlapsCube(placedIn(disc, box), box.half_edge + box.slack);
}

CellSets overlappedCells(const CellDisc& disc, const Vector& offset, float slack) {
    return BrickOverlap(disc, offset, slack).cells();
}

} // namespace pointrt

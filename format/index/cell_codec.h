// SPDX-License-Identifier: Apache-2.0
// Encodes the discs and balls of a cell for the tracer: near splats, and the two planes that enclose their parts in the
// cell (layout: pointrt/pro_index_layout.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

using Vector = std::array<float, 3>;

inline float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A splat in any unit. reach: half extents of its bounding box; slab: half the height of its blending slab. A ball has
/// the normal 0 and no slab: the tests of planes then never exclude it.
struct CellDisc {
    std::uint32_t splat = 0;
    Vector center{}, normal{}, reach{};
    float radius = 0, slab = 0;
    mutable std::uint32_t place = 0; ///< index in the lists of the block being encoded (cell_runs.cpp)

    bool isBall() const { return normal == Vector{}; }
};

/// A cube in the unit of the discs; slack enlarges it for tests.
struct CellBox {
    Vector middle{};
    float half_edge = 0, slack = 0;
};

/// Two planes perpendicular to the mean normal of discs (not empty) that enclose all their parts in the enlarged cell.
std::uint32_t slabWord(std::span<const CellDisc* const> discs, const CellBox& box);

/// Appends discs (not empty) as near splats relative to the middle of box, PRO_NEAR_WORDS each.
/// @return position codes per edge of box: exact as a half float, and also when scaled to edges 2^-PRO_CELL_OFFSET_BITS
/// times as long
float encodeNear(std::span<const CellDisc* const> discs, const CellBox& box, std::vector<std::uint32_t>& near);

/// Converts to a half float; exact for values that are half floats.
std::uint32_t toHalf(float value);

} // namespace pointrt

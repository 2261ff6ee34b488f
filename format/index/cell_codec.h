// SPDX-License-Identifier: Apache-2.0
// How the discs of a cell are written for the tracer: near splats, and the two planes that hold their parts in it
// (layout: pointrt/pro_index_layout.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

using Vector = std::array<float, 3>;

inline float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A splat, in any unit. reach is the half size of its disc's bounding box, slab half the height in which it blends.
struct CellDisc {
    std::uint32_t splat = 0;
    Vector center{}, normal{}, reach{};
    float radius = 0, slab = 0;
};

/// A cube, in the discs' unit; slack is by how much it is taken larger.
struct CellBox {
    Vector middle{};
    float half_edge = 0, slack = 0;
};

/// What cells are written to.
struct CellWords {
    std::vector<std::uint32_t> cells; ///< PRO_CELL_WORDS each
    std::vector<std::uint32_t> slabs; ///< one word each
    std::vector<std::uint32_t> near;  ///< PRO_NEAR_WORDS for each disc, and for one more where a cell's number is odd
};

/// Appends a cell with these discs (not empty, at most PRO_CELL_COUNT_MASK). first: the index of its first near splat.
void encodeCell(std::span<const CellDisc* const> discs, const CellBox& box, std::uint32_t first, CellWords& out);

} // namespace pointrt

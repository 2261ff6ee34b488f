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
    mutable std::uint32_t place = 0; ///< in what is made of its block at the time (cell_runs.cpp)
};

/// A cube, in the discs' unit; slack is by how much it is taken larger.
struct CellBox {
    Vector middle{};
    float half_edge = 0, slack = 0;
};

/// Two planes along the mean normal of discs (not empty), outside of all their parts in the cell and its slack.
std::uint32_t slabWord(std::span<const CellDisc* const> discs, const CellBox& box);

/// Appends discs (not empty) as near splats around the middle of box, PRO_NEAR_WORDS each. Position codes to an edge of
/// box, a number whose exact half there is even of an edge 2^-PRO_CELL_OFFSET_BITS as long.
float encodeNear(std::span<const CellDisc* const> discs, const CellBox& box, std::vector<std::uint32_t>& near);

/// The float as a half; exact for values that are halves.
std::uint32_t toHalf(float value);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The entry grid: a dense grid over the upper levels of the octree, with the extent of empty space.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "format/index/node_walk.h"
#include "format/index/page_vector.h"
#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

/// Covers the cells of one octree level, x fastest; everything outside is empty. Layout of the words:
/// pointrt/pro_index_layout.h.
struct EntryGrid {
    std::uint32_t shift = 0;               ///< log2 of a cell's edge in position steps
    std::array<std::uint32_t, 3> origin{}; ///< lowest cell, in cells from the corner of the cube
    std::array<std::uint32_t, 3> size{};   ///< in cells
    Words words;
    bool uneven = false; ///< so many leaves are deeper than the grid that brick cells need halving
};

/// Size in cell edges of the empty cube for a skip code, 1 to 15.
constexpr float skippedCells(std::uint32_t code) {
    return code == PRO_SKIP_MASK ? PRO_SKIP_FARTHEST : std::bit_cast<float>((code << PRO_SKIP_SHIFT) + PRO_SKIP_BIAS);
}
/// The largest skip code whose cube is at most this many edges wide; at least 1.
constexpr std::uint8_t skipCode(float cells) {
    std::uint32_t code = 1;
    while (code < PRO_SKIP_MASK && skippedCells(code + 1) <= cells) ++code;
    return static_cast<std::uint8_t>(code);
}

/// An empty word with skips of one cell in each direction.
constexpr std::uint32_t kEmptyWord = 0x11111111u;

/// Writes the skips of an empty word; does not change filled ones.
/// @param edges edges(octant) is the size of the empty cube in that direction, in edges of the cell
template <typename Edges>
void writeSkips(std::uint32_t& word, const Edges& edges) {
    if ((word & PRO_SKIP_MASK) == 0) return;
    word = 0;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        word |= std::uint32_t{skipCode(edges(octant))} << (PRO_SKIP_BITS * octant);
}

/// Cubes larger than this many edges have the same code.
constexpr auto kMaxSkipped = static_cast<std::uint8_t>(PRO_SKIP_FARTHEST);

/// A grid without words over the leaves of a validated file. @param deepest maximum octree depth of its cells
EntryGrid frameEntryGrid(const pro_info& info, const pro_view& view, std::uint32_t deepest = PRO_MAX_DEPTH);

/// Writes the words of a grid, with skips of whole grid cells.
/// @param corners lowest corners of the bricks, in position steps
/// @param threads maximum number; 0: one per core
void fillEntryGrid(EntryGrid& grid, std::span<const Corner> corners, std::size_t threads = 0);

} // namespace pointrt

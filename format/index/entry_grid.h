// SPDX-License-Identifier: Apache-2.0
// A dense grid over the octree's upper levels: where rays enter the tree, and how far empty space reaches.
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

/// Covers the cells of one depth of the octree; x runs fastest. Layout of the words: pointrt/pro_index_layout.h. What
/// is outside the grid is empty.
struct EntryGrid {
    std::uint32_t shift = 0;               ///< log2 of a cell's edge in position steps
    std::array<std::uint32_t, 3> origin{}; ///< of the lowest cell, in cells from the cube's corner
    std::array<std::uint32_t, 3> size{};   ///< in cells
    Words words;
    bool uneven = false; ///< so many of the octree's leaves lie deeper that cells are to be cut further
};

/// Edges of the empty cube that a skip code, 1 to 15, stands for.
constexpr float skippedCells(std::uint32_t code) {
    return code == PRO_SKIP_MASK ? PRO_SKIP_FARTHEST : std::bit_cast<float>((code << PRO_SKIP_SHIFT) + PRO_SKIP_BIAS);
}
/// The largest code for a cube of no more than so many edges, at least 1.
constexpr std::uint8_t skipCode(float cells) {
    std::uint32_t code = 1;
    while (code < PRO_SKIP_MASK && skippedCells(code + 1) <= cells) ++code;
    return static_cast<std::uint8_t>(code);
}

/// An empty word before its skips are known: one cell in each direction.
constexpr std::uint32_t kEmptyWord = 0x11111111u;

/// Writes an empty word's skips; leaves a filled one alone. edges(octant): of the empty cube towards it, in edges of
/// the word's own cell.
template <typename Edges>
void writeSkips(std::uint32_t& word, const Edges& edges) {
    if ((word & PRO_SKIP_MASK) == 0) return;
    word = 0;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        word |= std::uint32_t{skipCode(edges(octant))} << (PRO_SKIP_BITS * octant);
}

/// Whole edges of cubes larger than this make no difference to a code.
constexpr auto kMaxSkipped = static_cast<std::uint8_t>(PRO_SKIP_FARTHEST);

/// A grid without words over the leaves of a validated file, of cells at depth deepest of the octree or above.
EntryGrid frameEntryGrid(const pro_info& info, const pro_view& view, std::uint32_t deepest = PRO_MAX_DEPTH);

/// Writes the words of a grid without any, with skips of whole cells. corners: of its filled cells, in position steps;
/// brick k is the one at corners[k]. threads: at most; 0 is all cores.
void fillEntryGrid(EntryGrid& grid, std::span<const Corner> corners, std::size_t threads = 0);

} // namespace pointrt

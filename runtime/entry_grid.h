// SPDX-License-Identifier: Apache-2.0
// A dense grid over the octree's upper levels: where rays enter the tree, and how far empty space reaches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

/// Covers the cells of one depth of the octree that hold leaves or parts of them; x runs fastest. A word whose low
/// 4 bits are 0 is filled: with bit 4, bits 5 and up are the index of the leaf that the cell is or lies in, without it
/// the number of the group of the cell's children. In an empty cell's word
/// nibble k says how many cells (1 to 15) around and including it are empty towards octant k (bit 0 of k: x rising,
/// bit 1: y, bit 2: z); what is outside the grid is empty.
struct EntryGrid {
    std::uint32_t shift = 0;               ///< log2 of a cell's edge in position steps
    std::array<std::uint32_t, 3> origin{}; ///< of the lowest cell, in cells from the cube's corner
    std::array<std::uint32_t, 3> size{};   ///< in cells
    std::vector<std::uint32_t> words;
};

/// nodes are a validated file's NODE words, fewer than 2^27, with a leaf.
EntryGrid buildEntryGrid(std::span<const std::uint32_t> nodes, std::uint32_t leaf_count);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A dense grid over the octree's upper levels: where rays enter the tree, and how far empty space reaches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

/// 2^bits cells a side, x fastest. A word whose low 4 bits are 0 is node index << 4, of the cell's node or of the leaf
/// that encloses the cell. In an empty cell's word nibble k says how many cells (1 to 15) around and including it are
/// empty towards octant k (bit 0 of k: x rising, bit 1: y, bit 2: z).
struct EntryGrid {
    std::uint32_t bits = 0;
    std::vector<std::uint32_t> words;
};

/// nodes are a validated file's NODE words; node_count below 2^28. max_depth bounds the grid's.
EntryGrid buildEntryGrid(std::span<const std::uint32_t> nodes, std::uint32_t leaf_count, std::uint32_t max_depth);

} // namespace pointrt

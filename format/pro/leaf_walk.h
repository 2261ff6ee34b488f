// SPDX-License-Identifier: Apache-2.0
// Depth-first visit of the leaves of a checked octree.
#pragma once

#include <array>
#include <cstdint>

#include "pointrt/pro_layout.h"

namespace pointrt::format {

/// A cube of the octree: lowest corner in units of its own edge, 2^-depth of the whole.
struct Cell {
    std::uint32_t x = 0, y = 0, z = 0;
    std::uint32_t depth = 0;
};

/// Calls visit(leaf_index, cell) for every filled leaf in Morton order, over words that passed the breadth-first
/// checks: each group has one parent before it, and none lies deeper than PRO_MAX_DEPTH.
template <typename Visit>
void forEachLeaf(const std::uint32_t* nodes, Visit&& visit) {
    struct Pending {
        std::uint32_t node;
        Cell cell;
    };
    // of each group on the way down at most 7 children wait, and below the deepest group none is pushed
    std::array<Pending, 1 + 7 * PRO_MAX_DEPTH + 1> stack;
    std::size_t size = 0;
    stack[size++] = {nodes[0], {}};
    while (size > 0) {
        const Pending top = stack[--size];
        if (top.node == PRO_NODE_EMPTY) continue;
        if (!(top.node & PRO_NODE_INNER)) {
            visit(top.node - 1, top.cell);
            continue;
        }
        const std::uint32_t* group = nodes + std::size_t{top.node & PRO_NODE_GROUP_MASK} * PRO_GROUP_SIZE;
        for (std::uint32_t slot = PRO_GROUP_SIZE; slot-- > 0;) {
            if (group[slot] == PRO_NODE_EMPTY) continue;
            const Cell& cell = top.cell;
            stack[size++] = {
                group[slot],
                {cell.x * 2 + (slot & 1), cell.y * 2 + (slot >> 1 & 1), cell.z * 2 + (slot >> 2), cell.depth + 1}};
        }
    }
}

} // namespace pointrt::format

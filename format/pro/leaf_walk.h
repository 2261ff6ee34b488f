// SPDX-License-Identifier: Apache-2.0
// Depth-first traversal of the leaves of a validated octree.
#pragma once

#include <array>
#include <cstdint>

#include "pointrt/pro_layout.h"

namespace pointrt::format {

/// A cell of the octree: its lowest corner in units of its edge, which is 2^-depth of the cube's.
struct Cell {
    std::uint32_t x = 0, y = 0, z = 0;
    std::uint32_t depth = 0;
};

/// Calls visit(leaf_index, cell) for every filled leaf in Morton order. The words must have passed the breadth-first
/// checks: each group has one parent before it, and no group is deeper than PRO_MAX_DEPTH.
template <typename Visit>
void forEachLeaf(const std::uint32_t* nodes, Visit&& visit) {
    struct Pending {
        std::uint32_t node;
        Cell cell;
    };
    // at most 7 siblings wait at each depth, and the deepest group pushes no groups
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

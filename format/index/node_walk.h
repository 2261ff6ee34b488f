// SPDX-License-Identifier: Apache-2.0
// Traversal of an octree with the position of each node.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pointrt/pro_layout.h"

namespace pointrt {

using Corner = std::array<std::uint32_t, 3>; ///< lowest corner of a cell, in position steps

/// Calls visit(node word, corner, shift) for each non-empty node at depth and each filled leaf above it, in Morton
/// order; shift is log2 of the cell's edge in position steps.
/// @param nodes NODE words of a validated file
template <typename Visit>
void forNodes(std::span<const std::uint32_t> nodes, std::uint32_t depth, const Visit& visit, std::uint32_t index = 0,
              const Corner& corner = {}, std::uint32_t level = 0) {
    const std::uint32_t node = nodes[index], shift = PRO_POSITION_BITS - level;
    if (node == PRO_NODE_EMPTY) return;
    if (level == depth || !(node & PRO_NODE_INNER)) return visit(node, corner, shift);
    for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
        Corner child = corner;
        for (std::uint32_t axis = 0; axis < 3; ++axis) child[axis] += (slot >> axis & 1) << (shift - 1);
        forNodes(nodes, depth, visit, (node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + slot, child, level + 1);
    }
}

} // namespace pointrt

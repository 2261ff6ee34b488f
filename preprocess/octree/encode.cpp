// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "preprocess/octree/octree.h"

namespace pointrt {

namespace {

/// A cell and the leaves inside it.
struct Node {
    Cell cell;
    std::uint32_t begin, end;
};

} // namespace

std::vector<std::uint32_t> encodeNodes(const std::vector<Leaf>& leaves, std::uint32_t& max_depth) {
    std::vector<std::uint32_t> words(PRO_GROUP_SIZE, PRO_NODE_EMPTY);
    std::vector<Node> level{{Cell{}, 0, static_cast<std::uint32_t>(leaves.size())}}, next;
    std::vector<std::uint32_t> slots{0}, next_slots; // index in words of each node of the level
    max_depth = 0;
    for (; !level.empty(); level.swap(next), slots.swap(next_slots)) {
        next.clear();
        next_slots.clear();
        for (std::size_t i = 0; i < level.size(); ++i) {
            const Node& node = level[i];
            if (node.begin == node.end) continue;
            if (leaves[node.begin].cell.depth == node.cell.depth) {
                words[slots[i]] = node.begin + 1;
                max_depth = std::max(max_depth, node.cell.depth);
                continue;
            }
            const auto group_start = static_cast<std::uint32_t>(words.size());
            words[slots[i]] = PRO_NODE_INNER | (group_start / PRO_GROUP_SIZE);
            words.resize(words.size() + PRO_GROUP_SIZE, PRO_NODE_EMPTY);
            std::uint32_t begin = node.begin;
            for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
                const Cell child = childCell(node.cell, slot);
                const std::uint64_t limit = child.code + cellSpan(child.depth);
                const auto first = leaves.begin();
                const auto end = std::partition_point(first + begin, first + node.end,
                                                      [&](const Leaf& leaf) { return leaf.cell.code < limit; });
                const auto child_end = static_cast<std::uint32_t>(end - first);
                next.push_back({child, begin, child_end});
                next_slots.push_back(group_start + slot);
                begin = child_end;
            }
        }
    }
    return words;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The rule of octrees stored breadth first in groups of 8: the k-th node with children names group k + 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "format/pro/findings.h"
#include "pointrt/pro_layout.h"

namespace pointrt::format {

struct GroupScan {
    Tally group_number;      ///< nodes that do not name the next group
    Tally orphan;            ///< a group that no earlier node names; the scan ends there
    std::uint64_t inner = 0; ///< nodes with children
    std::uint32_t depth = 0; ///< of the nodes in the last group
};

/// The number of the group of a node's children, if it has any.
using ChildGroup = std::optional<std::uint32_t>;

/// Calls childrenOf(node, depth), which returns a ChildGroup, for each node in array order. Group g has a parent if at
/// least g nodes with children come before it. Groups of one depth are adjacent, so the depth grows where the groups
/// named by the depth above end.
template <typename ChildrenOf>
GroupScan scanGroups(std::size_t groups, const ChildrenOf& childrenOf) {
    GroupScan scan;
    std::uint64_t depth_end = 1;
    for (std::size_t group = 0; group < groups; ++group) {
        if (group > scan.inner) {
            scan.orphan.hit(group);
            break;
        }
        if (group == depth_end) {
            ++scan.depth;
            depth_end = scan.inner + 1;
        }
        for (std::size_t node = group * PRO_GROUP_SIZE; node < (group + 1) * PRO_GROUP_SIZE; ++node) {
            const ChildGroup children = childrenOf(node, scan.depth);
            if (children && *children != ++scan.inner) scan.group_number.hit(node);
        }
    }
    return scan;
}

} // namespace pointrt::format

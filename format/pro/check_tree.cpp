// SPDX-License-Identifier: Apache-2.0
#include "format/pro/checks.h"
#include "format/pro/group_scan.h"
#include "format/pro/leaf_walk.h"

namespace pointrt::format {

namespace {

bool checkGroups(const pro_info& info, const pro_view& view, Findings& findings) {
    if (info.node_count < PRO_GROUP_SIZE) return false; // checkRanges reports that
    const std::size_t before = findings.count();
    Tally root_group;
    for (std::size_t slot = 1; slot < PRO_GROUP_SIZE; ++slot)
        if (view.nodes[slot] != PRO_NODE_EMPTY) root_group.hit(slot);
    root_group.addTo(findings, Finding::kRootGroup, "node", "group 0 holds more than the root");

    Tally leaf_index;
    const GroupScan scan =
        scanGroups(info.node_count / PRO_GROUP_SIZE, [&](std::size_t index, std::uint32_t) -> ChildGroup {
            const std::uint32_t node = view.nodes[index];
            if (node & PRO_NODE_INNER) return node & PRO_NODE_GROUP_MASK;
            if (node > info.leaf_count) leaf_index.hit(index);
            return {};
        });
    scan.group_number.addTo(findings, Finding::kGroupNumber, "node", "does not name the next group");
    scan.orphan.addTo(findings, Finding::kGroupWithoutParent, "group", "no earlier node names it");
    leaf_index.addTo(findings, Finding::kLeafIndex, "node", "names a leaf out of range");
    if (scan.orphan.places == 0 && (scan.inner + 1) * PRO_GROUP_SIZE != info.node_count)
        findings.add(Finding::kGroupCount, "%llu inner nodes do not fit %u nodes",
                     static_cast<unsigned long long>(scan.inner), info.node_count);
    if (scan.depth != info.max_depth || scan.depth > PRO_MAX_DEPTH)
        findings.add(Finding::kDepth, "the tree has depth %u; the header says %u", scan.depth, info.max_depth);
    return findings.count() == before;
}

} // namespace

bool checkTree(const pro_info& info, const pro_view& view, Findings& findings) {
    if (!checkGroups(info, view, findings)) return false;
    std::uint64_t next = 0;
    Tally order;
    forEachLeaf(view.nodes, [&](std::uint32_t leaf, const Cell&) {
        if (leaf != next) order.hit(leaf);
        ++next;
    });
    order.addTo(findings, Finding::kLeafOrder, "leaf", "not in Morton order, or named twice");
    if (order.places == 0 && next != info.leaf_count)
        findings.add(Finding::kLeafOrder, "the tree names %llu of %u leaves", static_cast<unsigned long long>(next),
                     info.leaf_count);
    return order.places == 0 && next == info.leaf_count;
}

} // namespace pointrt::format

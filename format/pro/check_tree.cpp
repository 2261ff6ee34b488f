// SPDX-License-Identifier: Apache-2.0
#include "format/pro/checks.h"
#include "format/pro/leaf_walk.h"

namespace pointrt::format {

namespace {

struct GroupPass {
    Tally group_number, leaf_index, orphan;
    std::uint64_t inner = 0; // inner nodes met so far
    std::uint32_t depth = 0; // of the nodes in the last group met
};

void passNode(const pro_info& info, const pro_view& view, std::size_t index, GroupPass& pass) {
    const std::uint32_t node = view.nodes[index];
    if (node & PRO_NODE_INNER) {
        ++pass.inner;
        if ((node & PRO_NODE_GROUP_MASK) != pass.inner) pass.group_number.hit(index);
    } else if (node > info.leaf_count) {
        pass.leaf_index.hit(index);
    }
}

/// One pass in array order. Group g is reached when at least g inner nodes come before it; the groups of one depth
/// stand together, so the depth grows where the groups named by the depth above end.
GroupPass passGroups(const pro_info& info, const pro_view& view) {
    GroupPass pass;
    const std::size_t groups = info.node_count / PRO_GROUP_SIZE;
    std::uint64_t depth_end = 1;
    for (std::size_t group = 0; group < groups; ++group) {
        if (group > pass.inner) {
            pass.orphan.hit(group);
            break;
        }
        if (group == depth_end) {
            ++pass.depth;
            depth_end = pass.inner + 1;
        }
        for (std::size_t slot = 0; slot < PRO_GROUP_SIZE; ++slot)
            passNode(info, view, group * PRO_GROUP_SIZE + slot, pass);
    }
    return pass;
}

bool checkGroups(const pro_info& info, const pro_view& view, Findings& findings) {
    if (info.node_count < PRO_GROUP_SIZE) return false; // already a finding of checkRanges
    const std::size_t before = findings.count();
    Tally root_group;
    for (std::size_t slot = 1; slot < PRO_GROUP_SIZE; ++slot)
        if (view.nodes[slot] != PRO_NODE_EMPTY) root_group.hit(slot);
    root_group.addTo(findings, Finding::kRootGroup, "node", "group 0 holds more than the root");

    const GroupPass pass = passGroups(info, view);
    pass.group_number.addTo(findings, Finding::kGroupNumber, "node", "does not name the next group");
    pass.orphan.addTo(findings, Finding::kGroupWithoutParent, "group", "no node before it names it");
    pass.leaf_index.addTo(findings, Finding::kLeafIndex, "node", "names a leaf past the last");
    if (pass.orphan.places == 0 && (pass.inner + 1) * PRO_GROUP_SIZE != info.node_count)
        findings.add(Finding::kGroupCount, "%llu inner nodes do not fit %u nodes",
                     static_cast<unsigned long long>(pass.inner), info.node_count);
    if (pass.depth != info.max_depth || pass.depth > PRO_MAX_DEPTH)
        findings.add(Finding::kDepth, "the tree is %u deep, the header says %u", pass.depth, info.max_depth);
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

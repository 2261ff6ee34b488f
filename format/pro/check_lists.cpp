// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "format/pro/checks.h"
#include "format/pro/leaf.h"

namespace pointrt::format {

bool checkLeaves(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally reserved, empty, members, refs;
    std::uint64_t next_member = 0, next_ref = 0;
    for (std::size_t i = 0; i < info.leaf_count; ++i) {
        const Leaf leaf = loadLeaf(view.leaves, i);
        if (leaf.reserved != 0) reserved.hit(i);
        if (leaf.member_count + leaf.ref_count == 0) empty.hit(i);
        if (leaf.first_member != next_member) members.hit(i);
        if (leaf.first_ref != next_ref) refs.hit(i);
        next_member += leaf.member_count;
        next_ref += leaf.ref_count;
    }
    reserved.addTo(findings, Finding::kLeafReserved, "leaf", "its reserved word is not 0");
    empty.addTo(findings, Finding::kLeafEmpty, "leaf", "has neither members nor references");
    members.addTo(findings, Finding::kMemberRange, "leaf", "its members do not follow those of the previous leaf");
    refs.addTo(findings, Finding::kRefRange, "leaf", "its references do not follow those of the previous leaf");
    const bool totals = next_member == info.splat_count && next_ref == info.ref_count;
    if (!totals)
        findings.add(Finding::kLeafTotals, "leaves hold %llu members of %u and %llu references of %u",
                     static_cast<unsigned long long>(next_member), info.splat_count,
                     static_cast<unsigned long long>(next_ref), info.ref_count);
    return totals && reserved.places + empty.places + members.places + refs.places == 0;
}

bool checkRefs(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally index;
    for (std::size_t i = 0; i < info.ref_count; ++i)
        if (view.refs[i] >= info.splat_count) index.hit(i);
    index.addTo(findings, Finding::kRefIndex, "reference", "out of range");
    return index.places == 0;
}

void checkRefsOfLeaves(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally own, twice;
    std::vector<std::uint32_t> sorted;
    for (std::size_t i = 0; i < info.leaf_count; ++i) {
        const Leaf leaf = loadLeaf(view.leaves, i);
        sorted.assign(view.refs + leaf.first_ref, view.refs + leaf.first_ref + leaf.ref_count);
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) twice.hit(i);
        const auto first_own = std::lower_bound(sorted.begin(), sorted.end(), leaf.first_member);
        if (first_own != sorted.end() && *first_own - leaf.first_member < leaf.member_count) own.hit(i);
    }
    own.addTo(findings, Finding::kRefIsMember, "leaf", "refers to one of its own members");
    twice.addTo(findings, Finding::kRefTwice, "leaf", "refers to a splat twice");
}

void checkOrder(const pro_info& info, const pro_view& view, Level level, Findings& findings) {
    Tally twice;
    std::vector<bool> seen(info.splat_count);
    std::vector<std::uint32_t> above; // if input points were dropped, indices may exceed splat_count
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        const std::uint32_t index = view.order[i];
        if (index < info.splat_count) {
            if (seen[index]) twice.hit(i);
            seen[index] = true;
        } else if (level == Level::kVerify) {
            above.push_back(index);
        }
    }
    twice.addTo(findings, Finding::kOrderTwice, "splat", "its input index is used twice");
    std::sort(above.begin(), above.end());
    const auto equal = std::adjacent_find(above.begin(), above.end());
    if (equal != above.end()) findings.add(Finding::kOrderTwice, "input index %u is used twice", *equal);
}

} // namespace pointrt::format

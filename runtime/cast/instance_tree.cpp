// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/instance_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pointrt {
namespace {

/// Boxes per leaf: testing a few takes as long as descending one more level.
constexpr std::uint32_t kLeafBoxes = 4;
/// Stack size: halving 2^32 boxes takes 32 levels, each of which pushes one more node.
constexpr std::size_t kDeepest = 40;

double component(Vec3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

int longestAxis(const Bounds& box) {
    const Vec3 size = box.hi - box.lo;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

} // namespace

InstanceTree::InstanceTree(std::span<const Bounds> boxes) : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()));
    for (std::size_t i = 0; i < order_.size(); ++i) boxes_[i] = boxes[order_[i]];
}

void InstanceTree::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t number = nodes_.size();
    Bounds box = boxes_[order_[first]];
    for (std::uint32_t i = first + 1; i < first + count; ++i) box = joined(box, boxes_[order_[i]]);
    nodes_.push_back({box, first, count});
    if (count <= kLeafBoxes) return;
    const int axis = longestAxis(box);
    const auto middle = [&](std::uint32_t i) { return component(boxes_[i].lo + boxes_[i].hi, axis); };
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
    });
    build(first, half);
    nodes_[number].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[number].count = 0;
    build(first + half, count - half);
}

void InstanceTree::nextOfLeaf(const Node& leaf, const Line& line, const BoxEntry& after, BoxEntry& best) const {
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const RayInterval in = clipToBox({line.t_min, best.t}, line.origin, line.inverse, boxes_[i].lo, boxes_[i].hi);
        const BoxEntry entry{in.from, order_[i]};
        if (!in.isEmpty() && after < entry && entry < best) best = entry;
    }
}

BoxEntry InstanceTree::next(const Line& line, const BoxEntry& after, double t_max) const {
    BoxEntry best{t_max, kNoEntry};
    if (nodes_.empty()) return best;
    std::array<std::uint32_t, kDeepest> later{};
    std::size_t waiting = 0;
    later[waiting++] = 0;
    while (waiting > 0) {
        const std::uint32_t number = later[--waiting];
        const Node& node = nodes_[number];
        const RayInterval in = clipToBox({line.t_min, best.t}, line.origin, line.inverse, node.box.lo, node.box.hi);
        if (in.isEmpty() || in.to < after.t) continue; // its entries were all found before
        if (node.count > 0) {
            nextOfLeaf(node, line, after, best);
        } else { // the nearer child first, which ends the search sooner
            const bool rises = component(line.inverse, longestAxis(node.box)) > 0;
            later[waiting++] = rises ? node.first : number + 1;
            later[waiting++] = rises ? number + 1 : node.first;
        }
    }
    return best;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy that enumerates the boxes along a ray, nearest first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/cast/ray_interval.h"
#include "runtime/device_scene/render_space.h"

namespace pointrt {

/// A ray. Distances along it are in lengths of its direction.
struct Line {
    Vec3 origin;
    Vec3 inverse;     ///< reciprocal of the direction, per component
    double t_min = 0; ///< where it begins
};

/// Where a ray enters a box. Ordered by t, then by number.
struct BoxEntry {
    double t = 0;
    std::uint32_t box = 0;
    auto operator<=>(const BoxEntry&) const = default;
};

/// BoxEntry::box if there is no further box.
constexpr std::uint32_t kNoEntry = 0xFFFFFFFFu;
/// Sorts before every entry.
constexpr BoxEntry kBeforeAllEntries{-1, kNoEntry};

/// A binary tree, split at the median of the boxes' centres along the longest axis.
class InstanceTree {
public:
    explicit InstanceTree(std::span<const Bounds> boxes);

    /// The first entry after `after`, at most at t_max; its box is kNoEntry if there is none. Thread-safe.
    BoxEntry next(const Line& line, const BoxEntry& after, double t_max) const;

private:
    /// A leaf has count boxes, from first on in order_. An inner node has count 0; its children are the next node and
    /// `first`.
    struct Node {
        Bounds box;
        std::uint32_t first = 0, count = 0;
    };
    void build(std::uint32_t first, std::uint32_t count);
    void nextOfLeaf(const Node& leaf, const Line& line, const BoxEntry& after, BoxEntry& best) const;

    std::vector<Bounds> boxes_; ///< in the order of order_
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Which boxes a ray comes into, nearest first, one after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/cast/stretch.h"
#include "runtime/device_scene/render_space.h"

namespace pointrt {

/// A ray; lengths along it are in those of its direction.
struct Line {
    Vec3 origin;
    Vec3 inverse;     ///< one over the direction, by component
    double t_min = 0; ///< it begins there
};

/// Where a ray comes into a box: the order is by t, of equals by number.
struct Stop {
    double t = 0;
    std::uint32_t box = 0;
    auto operator<=>(const Stop&) const = default;
};

/// In place of a stop where there is none.
constexpr std::uint32_t kNoStop = 0xFFFFFFFFu;
/// Before all others.
constexpr Stop kBeforeAll{-1, kNoStop};

/// A tree of boxes, halved at the middle of their centres along its longest axis.
class TargetTree {
public:
    explicit TargetTree(std::span<const Bounds> boxes);

    /// The first stop after `after`, no farther than t_max; its box is kNoStop where there is none. From several
    /// threads. Takes as long as the tree is deep.
    Stop next(const Line& line, const Stop& after, double t_max) const;

private:
    /// count boxes from first on in order_; inside, with count 0, its children are the next one and `first`.
    struct Node {
        Bounds box;
        std::uint32_t first = 0, count = 0;
    };
    void build(std::uint32_t first, std::uint32_t count);
    void nextOfLeaf(const Node& leaf, const Line& line, const Stop& after, Stop& best) const;

    std::vector<Bounds> boxes_; ///< as order_ has them
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace pointrt

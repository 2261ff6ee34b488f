// SPDX-License-Identifier: Apache-2.0
// Points of a plane near another point, by a grid of cells.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "runtime/util/vec2.h"

namespace pointrt {

class NearPoints {
public:
    /// reach: above 0.
    NearPoints(std::span<const Vec2> points, double reach) : points_(points), reach_(reach) {
        for (std::uint32_t i = 0; i < points.size(); ++i)
            cells_[keyOf(columnOf(points[i].x), columnOf(points[i].y))].push_back(i);
    }

    /// Calls visit with the index of each point within reach, in a deterministic order.
    template <typename Visit>
    void forNear(Vec2 point, const Visit& visit) const {
        const std::int64_t column = columnOf(point.x), row = columnOf(point.y);
        for (std::int64_t x = column - 1; x <= column + 1; ++x)
            for (std::int64_t y = row - 1; y <= row + 1; ++y) {
                const auto cell = cells_.find(keyOf(x, y));
                if (cell == cells_.end()) continue;
                for (const std::uint32_t i : cell->second)
                    if (length(points_[i] - point) <= reach_) visit(i);
            }
    }

private:
    std::int64_t columnOf(double coordinate) const {
        return static_cast<std::int64_t>(std::floor(coordinate / reach_));
    }
    static std::uint64_t keyOf(std::int64_t column, std::int64_t row) {
        return static_cast<std::uint64_t>(column) << 32 ^ (static_cast<std::uint64_t>(row) & 0xffffffffu);
    }

    std::span<const Vec2> points_;
    double reach_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

} // namespace pointrt

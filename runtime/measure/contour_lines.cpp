// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/contour_lines.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace pointrt {
namespace {

/// The id of a grid edge, shared by two squares: twice the number of its lower left node, plus one if it is vertical.
using SideId = std::uint64_t;
constexpr SideId kNoSide = std::numeric_limits<SideId>::max();

/// Corners and sides of a square go counterclockwise from the lower left corner and the lower side.
constexpr std::size_t kCorners = 4;

class LevelTracer {
public:
    LevelTracer(const HeightRaster& raster, double level) : raster_(raster), level_(level) {}

    std::vector<ContourLine> lines() {
        for (std::size_t row = 0; row + 1 < raster_.rows; ++row)
            for (std::size_t column = 0; column + 1 < raster_.columns; ++column) addSquare(column, row);
        std::vector<ContourLine> found;
        for (const SideId start : starts_)
            if (!has_former_.contains(start)) follow(start, found); // lines with two ends; loops follow
        for (const SideId start : starts_) follow(start, found);
        return found;
    }

private:
    /// Links the sides at which the line enters and leaves a square.
    void addSquare(std::size_t column, std::size_t row) {
        const std::array<double, kCorners> heights{raster_.at(column, row), raster_.at(column + 1, row),
                                                   raster_.at(column + 1, row + 1), raster_.at(column, row + 1)};
        std::array<bool, kCorners> above{};
        std::size_t count = 0;
        double sum = 0;
        for (std::size_t k = 0; k < kCorners; ++k) {
            sum += heights[k];
            above[k] = heights[k] >= level_;
            count += above[k] ? 1 : 0;
        }
        if (std::isnan(sum) || count == 0 || count == kCorners) return;
        const SideId node = 2 * (SideId{row} * raster_.columns + column);
        const std::array<SideId, kCorners> sides{node, node + 3, node + 2 * raster_.columns, node + 1};
        const bool is_saddle = above[0] == above[2] && above[1] == above[3];
        const bool joins_high = is_saddle && sum / kCorners >= level_;
        // with high ground on its left, going counterclockwise a line enters where corners fall and leaves where they
        // rise
        for (std::size_t enters = 0; enters < kCorners; ++enters) {
            if (!above[enters] || above[(enters + 1) % kCorners]) continue;
            std::size_t leaves = (enters + (joins_high ? 1 : kCorners - 1)) % kCorners;
            const std::size_t step = joins_high ? 1 : kCorners - 1;
            while (above[leaves] || !above[(leaves + 1) % kCorners]) leaves = (leaves + step) % kCorners;
            next_[sides[enters]] = sides[leaves];
            has_former_[sides[leaves]] = true;
            starts_.push_back(sides[enters]);
        }
    }

    /// Removes the line that starts at a side from next_ and appends it.
    void follow(SideId start, std::vector<ContourLine>& found) {
        if (!next_.contains(start)) return;
        ContourLine line;
        for (SideId side = start; side != kNoSide;) {
            line.points.push_back(crossing(side));
            const auto link = next_.find(side);
            if (link == next_.end()) break;
            side = link->second;
            next_.erase(link);
            line.closed = side == start;
            if (line.closed) break;
        }
        found.push_back(std::move(line));
    }

    RasterPoint crossing(SideId side) const {
        const std::size_t node = side / 2, column = node % raster_.columns, row = node / raster_.columns;
        const bool upwards = side % 2 == 1;
        const double from = raster_.at(column, row);
        const double to = upwards ? raster_.at(column, row + 1) : raster_.at(column + 1, row);
        const double share = (level_ - from) / (to - from);
        return {static_cast<double>(column) + (upwards ? 0 : share), static_cast<double>(row) + (upwards ? share : 0)};
    }

    const HeightRaster& raster_;
    double level_;
    std::unordered_map<SideId, SideId> next_;
    std::unordered_map<SideId, bool> has_former_;
    std::vector<SideId> starts_; ///< in the order of the raster, so that results do not depend on hashes
};

} // namespace

std::vector<ContourLine> contourLines(const HeightRaster& raster, double level) {
    return LevelTracer(raster, level).lines();
}

} // namespace pointrt

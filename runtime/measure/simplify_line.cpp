// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>

#include "runtime/measure/section_hits.h"

namespace pointrt {
namespace {

/// With this many points between two corners or more, a fit is better than the line between the corners.
constexpr std::size_t kLeastFitted = 3;
/// cos(30 degrees): smaller turns belong to curves. On a curve, fits cross outside it by 2/3 of the sagitta, whereas
/// the given corner lies on it; a corner between the two preserves the curve's length.
constexpr double kCurved = 0.866;

/// The indices that Douglas and Peucker's method keeps, including the first and the last.
std::vector<std::size_t> keptCorners(std::span<const Vec2> points, double tolerance) {
    std::vector<bool> is_kept(points.size());
    is_kept.front() = is_kept.back() = true;
    std::vector<std::array<std::size_t, 2>> open{{0, points.size() - 1}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double most = tolerance;
        std::size_t farthest = from;
        for (std::size_t i = from + 1; i < to; ++i)
            if (const double distance = distanceToSegment(points[i], points[from], points[to]); distance > most) {
                most = distance;
                farthest = i;
            }
        if (farthest == from) continue;
        is_kept[farthest] = true;
        open.push_back({from, farthest});
        open.push_back({farthest, to});
    }
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (is_kept[i]) corners.push_back(i);
    return corners;
}

/// Opens a closed line at its sharpest corner, where it then starts and ends, since the start is kept.
std::vector<Vec2> opened(const PlaneLine& line, double tolerance) {
    std::vector<Vec2> points = line.points;
    const auto farthest =
        std::ranges::max_element(points, {}, [first = points.front()](Vec2 point) { return length(point - first); });
    std::ranges::rotate(points, farthest);
    points.push_back(points.front());
    const std::vector<std::size_t> corners = keptCorners(points, tolerance);
    double sharpest = 2;
    std::size_t start = 0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec2 before = points[corners[k]] - points[corners[k - 1]];
        const Vec2 after = points[corners[k + 1]] - points[corners[k]];
        const double straightness = dot(before, after) / (length(before) * length(after));
        if (straightness >= sharpest) continue;
        sharpest = straightness;
        start = corners[k];
    }
    points.pop_back();
    std::ranges::rotate(points, points.begin() + static_cast<std::ptrdiff_t>(start));
    points.push_back(points.front());
    return points;
}

class CornerFit {
public:
    CornerFit(std::span<const Vec2> points, bool closed, double tolerance)
        : points_(points), closed_(closed), tolerance_(tolerance), corners_(keptCorners(points, tolerance)) {}

    PlaneLine fitted() {
        PlaneLine line{{}, closed_};
        for (std::size_t k = 0; k + 1 < corners_.size(); ++k) pieces_.push_back(pieceAfter(k));
        for (std::size_t k = 0; k < corners_.size(); ++k) line.points.push_back(cornerAt(k));
        while (restoreFarPieces(line.points)) {
        }
        if (closed_) line.points.pop_back();
        return line;
    }

private:
    StraightLine pieceAfter(std::size_t k) const {
        const std::size_t from = corners_[k], to = corners_[k + 1];
        const std::span<const Vec2> between = points_.subspan(from + 1, to - from - 1);
        if (between.size() >= kLeastFitted) return fitStraight(between);
        return fitStraight(std::array{points_[from], points_[to]});
    }

    Vec2 cornerAt(std::size_t k) const {
        const Vec2 given = points_[corners_[k]];
        const bool is_first = k == 0, is_last = k + 1 == corners_.size();
        if (!closed_ && is_first) return pieces_.front().nearestTo(given);
        if (!closed_ && is_last) return pieces_.back().nearestTo(given);
        const StraightLine &before = is_first ? pieces_.back() : pieces_[k - 1],
                           &after = is_last ? pieces_.front() : pieces_[k];
        const auto crossing = crossingOf(before, after);
        if (crossing && length(*crossing - given) <= 2 * tolerance_)
            return std::abs(dot(before.direction, after.direction)) < kCurved ? *crossing : 0.5 * (*crossing + given);
        return 0.5 * (before.nearestTo(given) + after.nearestTo(given));
    }

    /// Moves the corners of a piece back to their given places if a point is too far from the piece. Returns whether
    /// any moved; repeated calls end, since each corner moves back only once.
    bool restoreFarPieces(std::vector<Vec2>& fitted) const {
        bool is_changed = false;
        for (std::size_t k = 0; k + 1 < corners_.size(); ++k) {
            const std::span<const Vec2> piece = points_.subspan(corners_[k], corners_[k + 1] - corners_[k] + 1);
            const bool is_far = std::ranges::any_of(
                piece, [&](Vec2 point) { return distanceToSegment(point, fitted[k], fitted[k + 1]) > tolerance_; });
            if (!is_far) continue;
            is_changed = restore(fitted, k) || is_changed;
            is_changed = restore(fitted, k + 1) || is_changed;
        }
        return is_changed;
    }

    bool restore(std::vector<Vec2>& fitted, std::size_t k) const {
        const bool is_seam = closed_ && (k == 0 || k + 1 == corners_.size());
        const bool was_fitted = !(fitted[k] == points_[corners_[k]]);
        fitted[k] = points_[corners_[k]];
        if (is_seam) fitted.front() = fitted.back() = fitted[k];
        return was_fitted;
    }

    std::span<const Vec2> points_;
    bool closed_;
    double tolerance_;
    std::vector<std::size_t> corners_;
    std::vector<StraightLine> pieces_; ///< one fewer than corners
};

} // namespace

PlaneLine simplified(const PlaneLine& line, double tolerance) {
    constexpr std::size_t kLeastClosed = 4; // a triangle cannot be simplified
    if (line.points.size() < (line.closed ? kLeastClosed : 3)) return line;
    const std::vector<Vec2> points = line.closed ? opened(line, tolerance) : line.points;
    return CornerFit(points, line.closed, tolerance).fitted();
}

} // namespace pointrt

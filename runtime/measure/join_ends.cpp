// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "runtime/measure/near_points.h"
#include "runtime/measure/section_hits.h"

namespace pointrt {
namespace {

constexpr std::size_t kFittedPoints = 8; ///< number of points that determine an end's direction
/// Steps by which an end may overshoot a corner: the discs of a wall end up to a radius before or beyond the corner.
constexpr double kOvershoot = 2.5;
constexpr double kStraight = 0.866;     ///< cos(30 degrees): largest turn between ends that continue each other
constexpr double kStraightSlope = 0.27; ///< tan(15 degrees): largest sideways offset of the other end
constexpr double kSharpest = 0.5;       ///< cos(60 degrees): sharper corners are mostly adjacent lines in noise

/// The first or last point of a line. Ends are numbered: 2 * line for the first, one more for the last.
struct LineEnd {
    Vec2 at;
    Vec2 out;              ///< unit length, pointing out of the line
    StraightLine straight; ///< fitted to the end
};

struct Join {
    double cost = 0;
    std::uint32_t a = 0, b = 0;
    std::optional<Vec2> corner;
};

LineEnd endOf(const PlaneLine& line, bool last) {
    const std::size_t count = std::min(kFittedPoints, line.points.size());
    const std::span<const Vec2> all = line.points, some = last ? all.last(count) : all.first(count);
    const Vec2 at = last ? all.back() : all.front(), inside = last ? some.front() : some.back();
    const StraightLine straight = fitStraight(some);
    const double sign = dot(at - inside, straight.direction) < 0 ? -1 : 1;
    return {at, sign * straight.direction, straight};
}

std::optional<Join> joinOf(const LineEnd& a, const LineEnd& b, double step, double gap) {
    const Vec2 d = b.at - a.at;
    const double overshoot = kOvershoot * step;
    if (dot(a.out, b.out) <= -kStraight) {
        const double ahead = dot(a.out, d), aside = std::max(std::abs(cross(a.out, d)), std::abs(cross(b.out, d)));
        if (ahead < -overshoot || aside > step + kStraightSlope * std::abs(ahead)) return {};
        return Join{length(d), 0, 0, ahead < 0 ? std::optional(a.at + 0.5 * d) : std::nullopt};
    }
    const auto corner = crossingOf(a.straight, b.straight);
    if (!corner || dot(a.out, b.out) > kSharpest) return {};
    const double of_a = dot(*corner - a.at, a.out), of_b = dot(*corner - b.at, b.out);
    if (std::min(of_a, of_b) < -overshoot || std::max(of_a, of_b) > gap) return {};
    return Join{std::abs(of_a) + std::abs(of_b), 0, 0, corner};
}

class EndJoiner {
public:
    EndJoiner(std::vector<PlaneLine> lines, double step, double gap) : lines_(std::move(lines)) {
        for (const PlaneLine& line : lines_) {
            ends_.push_back(endOf(line, false));
            ends_.push_back(endOf(line, true));
        }
        joins_.resize(ends_.size());
        for (const Join& join : possibleJoins(step, gap)) accept(join);
    }

    std::vector<PlaneLine> joined() {
        std::vector<PlaneLine> found;
        is_taken_.assign(lines_.size(), false);
        for (std::uint32_t end = 0; end < ends_.size(); ++end)
            if (!joins_[end]) take(end, found);
        for (std::uint32_t end = 0; end < ends_.size(); ++end) take(end, found); // loops
        return found;
    }

private:
    std::vector<Join> possibleJoins(double step, double gap) const {
        std::vector<Vec2> places;
        for (const LineEnd& end : ends_) places.push_back(end.at);
        const NearPoints near(places, gap);
        std::vector<Join> possible;
        for (std::uint32_t a = 0; a < ends_.size(); ++a) {
            if (lines_[a / 2].closed) continue;
            near.forNear(ends_[a].at, [&](std::uint32_t b) {
                if (b <= a || lines_[b / 2].closed || isTooShortToClose(a, b)) return;
                auto join = joinOf(ends_[a], ends_[b], step, gap);
                if (!join) return;
                join->a = a;
                join->b = b;
                possible.push_back(*join);
            });
        }
        std::ranges::stable_sort(possible, {}, &Join::cost);
        return possible;
    }

    /// Whether joining a line to itself would enclose too little.
    bool isTooShortToClose(std::uint32_t a, std::uint32_t b) const {
        return a / 2 == b / 2 && lengthOf(lines_[a / 2]) < 3 * length(ends_[a].at - ends_[b].at);
    }

    void accept(const Join& join) {
        if (joins_[join.a] || joins_[join.b]) return;
        joins_[join.a] = joins_[join.b] = join;
        if (!join.corner) return;
        trim(join.a, *join.corner);
        trim(join.b, *join.corner);
    }

    /// Drops the points beyond a corner.
    void trim(std::uint32_t end, Vec2 corner) {
        std::vector<Vec2>& points = lines_[end / 2].points;
        const bool last = end % 2 == 1;
        while (points.size() > 1 && dot((last ? points.back() : points.front()) - corner, ends_[end].out) > 0)
            points.erase(last ? points.end() - 1 : points.begin());
    }

    /// Follows joins from an end inwards.
    void take(std::uint32_t end, std::vector<PlaneLine>& found) {
        if (is_taken_[end / 2]) return;
        PlaneLine line;
        const std::uint32_t start = end;
        for (;;) {
            PlaneLine& piece = lines_[end / 2];
            is_taken_[end / 2] = true;
            if (end % 2 == 1) std::ranges::reverse(piece.points);
            line.points.insert(line.points.end(), piece.points.begin(), piece.points.end());
            line.closed = piece.closed;
            const auto& join = joins_[end ^ 1];
            if (!join) break;
            if (join->corner) line.points.push_back(*join->corner);
            end = join->a == (end ^ 1) ? join->b : join->a;
            line.closed = end == start;
            if (line.closed) break;
        }
        found.push_back(std::move(line));
    }

    std::vector<PlaneLine> lines_;
    std::vector<LineEnd> ends_;
    std::vector<std::optional<Join>> joins_; ///< of each end
    std::vector<bool> is_taken_;             ///< of each line
};

} // namespace

std::vector<PlaneLine> joinEnds(std::vector<PlaneLine> lines, double step, double gap) {
    return EndJoiner(std::move(lines), step, gap).joined();
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/scan_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pointrt::surface {
namespace {

/// Neighbours that tell a line: with fewer, one in twenty among points spread at random does.
constexpr std::size_t kLinePoints = 6;

/// Spread across a line over that along it, both as variances: a third as far.
constexpr float kLineWidth = 1.0f / 9;

/// Gaps between lines in steps along them. Nearer ones close with discs that are hardly wider than the step; of further
/// ones a spinning lidar has few: 0.17 degrees along and 0.4 across meet the ground 40 m away at 1 to 57.
constexpr float kLeastGap = 3, kMostGap = 128;

/// Cosine of 30 degrees between the normals on both sides; each then lies 15 degrees off the way across.
constexpr float kSameSurface = 0.866f, kMostSlope = 0.27f;
/// Cosine of 25 degrees between the lines.
constexpr float kParallel = 0.9f;
/// Heights of the nearest points over the plane through both lines, of the gap.
constexpr float kFlatness = 0.1f;

/// A point's way to another, split by its own line.
struct Way {
    float along, across, height;

    /// Whether it leads over the gap rather than along the line.
    bool crosses(float least) const { return across >= least && across >= std::abs(along); }
};

struct Sides {
    Vec3f origin, along, across, normal;

    Way to(const Vec3f& other) const {
        const Vec3f offset = other - origin;
        return {along.dot(offset), across.dot(offset), normal.dot(offset)};
    }
    Vec3f at(const Way& way, float share) const { return origin + share * (way.across * across + way.height * normal); }
};

/// The point nearest to a place that lies across, at most `most` away from the place.
std::optional<std::uint32_t> nearestAcross(const LineJob& job, const Sides& sides, const Vec3f& place, float most,
                                           float least) {
    std::array<std::uint32_t, 4> found;
    std::array<float, 4> squared;
    const std::size_t count = job.search.nearest(place, found, squared, most * most);
    for (std::size_t i = 0; i < count; ++i)
        if (sides.to(job.points.positions[found[i]]).crosses(least)) return found[i];
    return {};
}

/// The nearest point across: places further and further out are asked, each as far as half the way to it.
std::optional<std::uint32_t> firstAcross(const LineJob& job, const Sides& sides, float step) {
    for (float gap = (kLeastGap + 1) * step; gap <= kMostGap * step; gap *= 2)
        if (const auto found = nearestAcross(job, sides, sides.at({0, gap, 0}, 1), gap / 2, kLeastGap * step))
            return found;
    return {};
}

/// The point of the next line that lies straight across, if nothing stands between.
std::optional<std::uint32_t> straightAcross(const LineJob& job, const Sides& sides, float step) {
    constexpr float kBetween = 0.35f; // of the gap, from its middle
    const auto first = firstAcross(job, sides, step);
    if (!first) return {};
    const Way way = sides.to(job.points.positions[*first]);
    const float least = kLeastGap * step;
    if (nearestAcross(job, sides, sides.at(way, 0.5f), kBetween * way.across, least)) return {};
    return nearestAcross(job, sides, sides.at(way, 1), way.across, least);
}

/// Whether the points next to one lie in a plane.
bool liesIn(const LineJob& job, std::size_t point, const Vec3f& origin, const Vec3f& normal, float highest) {
    const auto next = job.lists.of(point).first(2);
    return std::all_of(next.begin(), next.end(), [&](std::uint32_t neighbor) {
        return std::abs(normal.dot(job.points.positions[neighbor] - origin)) <= highest;
    });
}

} // namespace

std::optional<ScanLine> lineAt(const LineJob& job, std::size_t point) {
    if (job.lists.k < kLinePoints) return {};
    const Vec3f origin = job.points.positions[point], normal = job.points.normals[point];
    const Vec3f u = normal.unitOrthogonal(), v = normal.cross(u);
    float xx = 0, xy = 0, yy = 0;
    const auto nearest = job.lists.of(point).first(kLinePoints);
    for (const std::uint32_t neighbor : nearest) {
        const Vec3f offset = job.points.positions[neighbor] - origin;
        const float x = u.dot(offset), y = v.dot(offset);
        xx += x * x, xy += x * y, yy += y * y;
    }
    const float half = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
    if (!(half - apart <= kLineWidth * (half + apart)) || !(apart > 0)) return {};
    const float angle = std::atan2(xy, (xx - yy) / 2) / 2;
    ScanLine line{std::cos(angle) * u + std::sin(angle) * v, 0};
    float first = 0, last = 0;
    for (const std::uint32_t neighbor : nearest) {
        const float place = line.along.dot(job.points.positions[neighbor] - origin);
        first = std::min(first, place), last = std::max(last, place);
    }
    line.step = (last - first) / float(kLinePoints);
    return line;
}

std::optional<Facing> facingLine(const LineJob& job, std::size_t point, const ScanLine& line, float side) {
    const Vec3f origin = job.points.positions[point], normal = job.points.normals[point];
    const Sides sides{origin, line.along, side * normal.cross(line.along), normal};
    const auto other = straightAcross(job, sides, line.step);
    if (!other) return {};
    const Way way = sides.to(job.points.positions[*other]);
    const Vec3f across = sides.at(way, 1) - origin;
    const float gap = across.norm();
    if (gap > kMostGap * line.step) return {};

    const Vec3f far_normal = job.points.normals[*other];
    const float cosine = normal.dot(far_normal);
    const Vec3f between = (normal + std::copysign(1.0f, cosine) * far_normal).normalized();
    if (std::abs(cosine) < kSameSurface || std::abs(far_normal.dot(across)) > kMostSlope * gap ||
        std::abs(way.height) > kMostSlope * gap || std::abs(between.dot(across)) > kFlatness * gap)
        return {};
    const std::optional<ScanLine> next = lineAt(job, *other);
    if (!next || std::abs(next->along.dot(line.along)) < kParallel) return {};
    const bool flat = liesIn(job, point, origin, between, kFlatness * gap) &&
                      liesIn(job, *other, job.points.positions[*other], between, kFlatness * gap);
    if (!flat) return {};
    return Facing{*other, across};
}

} // namespace pointrt::surface

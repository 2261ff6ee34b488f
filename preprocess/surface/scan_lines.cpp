// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/scan_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

namespace pointrt::surface {
namespace {

/// Neighbours needed to detect a line: with fewer, one in twenty random points seems to be on one.
constexpr std::size_t kLinePoints = 6;

/// Largest variance across a line over that along it: a third of the spread.
constexpr float kLineWidth = 1.0f / 9;

/// Gaps between lines in steps along them. Discs hardly wider than a step close narrower gaps. With 0.17 degrees along
/// and 0.4 across, a spinning lidar's are 57 steps on the ground 40 m away; profiles of a road are 5 mm along and up to
/// 2.5 m apart, which is 500 steps.
constexpr float kLeastGap = 3, kMostGap = 512;

/// Cosine of 30 degrees between the normals on both sides; each is then 15 degrees off the direction across.
constexpr float kSameSurface = 0.866f, kMostSlope = 0.27f;
/// Cosine of 25 degrees between the lines.
constexpr float kParallel = 0.9f;
/// Largest height of the nearest points over the plane through both lines, in gap widths.
constexpr float kFlatness = 0.1f;

/// Offset from a point to another, relative to the point's line.
struct Offset {
    float along, across, height;

    /// Whether it crosses the gap rather than follow the line.
    bool crosses(float least) const { return across >= least && across >= std::abs(along); }
};

constexpr std::array<float, 2> kBothWays{1.0f, -1.0f};

/// Frame of a line at a point: along it, across it and normal to the surface.
struct LineFrame {
    Vec3f origin, along, across, normal;

    Offset to(const Vec3f& other) const {
        const Vec3f offset = other - origin;
        return {along.dot(offset), across.dot(offset), normal.dot(offset)};
    }
    Vec3f at(const Offset& to, float share) const { return origin + share * (to.across * across + to.height * normal); }
};

/// The point nearest to a place that is across the gap, at most `most` away from the place.
std::optional<std::uint32_t> nearestAcross(const PointGraph& graph, const LineFrame& frame, const Vec3f& place,
                                           float most, float least) {
    std::array<std::uint32_t, 4> found;
    std::array<float, 4> squared;
    const std::size_t count = graph.search->nearest(place, found, squared, most * most);
    for (std::size_t i = 0; i < count; ++i)
        if (frame.to(graph.points.positions[found[i]]).crosses(least)) return found[i];
    return {};
}

/// The nearest point across the gap: searches at doubling distances, each within half its distance.
std::optional<std::uint32_t> firstAcross(const PointGraph& graph, const LineFrame& frame, float step) {
    for (float gap = (kLeastGap + 1) * step; gap <= kMostGap * step; gap *= 2)
        if (const auto found = nearestAcross(graph, frame, frame.at({0, gap, 0}, 1), gap / 2, kLeastGap * step))
            return found;
    return {};
}

/// The point of the next line straight across, if nothing is in between.
std::optional<std::uint32_t> straightAcross(const PointGraph& graph, const LineFrame& frame, float step) {
    constexpr float kBetween = 0.35f; // of the gap, around its middle
    const auto first = firstAcross(graph, frame, step);
    if (!first) return {};
    const Offset to = frame.to(graph.points.positions[*first]);
    const float least = kLeastGap * step;
    if (nearestAcross(graph, frame, frame.at(to, 0.5f), kBetween * to.across, least)) return {};
    return nearestAcross(graph, frame, frame.at(to, 1), to.across, least);
}

/// Whether the two nearest neighbours of a point lie in a plane.
bool liesIn(const PointGraph& graph, std::size_t point, const Vec3f& origin, const Vec3f& normal, float highest) {
    const auto next = graph.lists.of(point).first(2);
    return std::all_of(next.begin(), next.end(), [&](std::uint32_t neighbor) {
        return std::abs(normal.dot(graph.points.positions[neighbor] - origin)) <= highest;
    });
}

/// Whether the line continues for at least half the gap on one side. A clump of points may be as narrow as a line, and
/// the next clump as far away as the next line.
bool goesOn(const PointGraph& graph, const LineFrame& frame, float gap) {
    std::array<std::uint32_t, 1> found;
    std::array<float, 1> squared;
    return std::any_of(kBothWays.begin(), kBothWays.end(), [&](float way) {
        const Vec3f place = frame.origin + way * gap / 2 * frame.along;
        return graph.search->nearest(place, found, squared, gap * gap / 16) > 0;
    });
}

/// The line along a point's nearest neighbours, if they lie on one.
std::optional<ScanLine> lineThrough(const PointGraph& graph, std::size_t point,
                                    std::span<const std::uint32_t> nearest) {
    const Vec3f origin = graph.points.positions[point], normal = graph.points.normals[point];
    const Vec3f u = normal.unitOrthogonal(), v = normal.cross(u);
    float xx = 0, xy = 0, yy = 0;
    for (const std::uint32_t neighbor : nearest) {
        const Vec3f offset = graph.points.positions[neighbor] - origin;
        const float x = u.dot(offset), y = v.dot(offset);
        xx += x * x, xy += x * y, yy += y * y;
    }
    const float half = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
    if (!(half - apart <= kLineWidth * (half + apart)) || !(apart > 0)) return {};
    const float angle = std::atan2(xy, (xx - yy) / 2) / 2;
    ScanLine line{std::cos(angle) * u + std::sin(angle) * v, 0};
    float first = 0, last = 0;
    for (const std::uint32_t neighbor : nearest) {
        const float place = line.along.dot(graph.points.positions[neighbor] - origin);
        first = std::min(first, place), last = std::max(last, place);
    }
    line.step = (last - first) / float(nearest.size());
    return line;
}

} // namespace

std::optional<ScanLine> lineAt(const PointGraph& graph, std::size_t point) {
    const NeighborLists& lists = graph.lists;
    if (lists.k < kLinePoints || (lists.thinned[point] & kClump)) return {};
    if (const auto line = lineThrough(graph, point, lists.of(point).first(kLinePoints))) return line;
    // Noise as wide as a step hides the line from six points, but not from all that are near.
    if (!lists.thinned[point]) return {};
    return lineThrough(graph, point, lists.of(point).first(lists.denseCount()));
}

std::optional<Facing> facingLine(const PointGraph& graph, std::size_t point, const ScanLine& line, float side) {
    const Vec3f origin = graph.points.positions[point], normal = graph.points.normals[point];
    const LineFrame frame{origin, line.along, side * normal.cross(line.along), normal};
    const auto other = straightAcross(graph, frame, line.step);
    if (!other) return {};
    const Offset to = frame.to(graph.points.positions[*other]);
    const Vec3f across = frame.at(to, 1) - origin;
    const float gap = across.norm();
    if (gap > kMostGap * line.step || !goesOn(graph, frame, gap)) return {};

    const Vec3f far_normal = graph.points.normals[*other];
    const float cosine = normal.dot(far_normal);
    const Vec3f between = (normal + std::copysign(1.0f, cosine) * far_normal).normalized();
    if (std::abs(cosine) < kSameSurface || std::abs(far_normal.dot(across)) > kMostSlope * gap ||
        std::abs(to.height) > kMostSlope * gap || std::abs(between.dot(across)) > kFlatness * gap)
        return {};
    const std::optional<ScanLine> next = lineAt(graph, *other);
    if (!next || std::abs(next->along.dot(line.along)) < kParallel) return {};
    const bool flat = liesIn(graph, point, origin, between, kFlatness * gap) &&
                      liesIn(graph, *other, graph.points.positions[*other], between, kFlatness * gap);
    if (!flat) return {};
    return Facing{*other, across};
}

} // namespace pointrt::surface

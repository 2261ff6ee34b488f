// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/radii.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/plane_fit.h"
#include "preprocess/surface/voronoi_cell.h"

namespace pointrt::surface {
namespace {

/// Disc radius over closing radius. The viewer blends discs with the weight (1 - d^2 / r^2)^2, whose sum must stay well
/// above zero everywhere. It is lowest at the corners of the cells, where three discs or more meet at d = r / kOverlap:
/// 3 (1 - 1 / 1.4^2)^2 = 0.72. Measured over square, hexagonal, jittered, Poisson-disc and random points in a plane the
/// lowest sum is 0.63 to 0.96, the median 0.76 to 1.9; at 1.3 the lowest is 0.43, at 1.5 there are a seventh more
/// discs.
constexpr float kOverlap = 1.4f;

/// The same where a disc would hang over a crease or the border of the scan, there for all to see. Where two such discs
/// meet two others the sum is 2 (1 - 1 / 1.4^2)^2 + 2 (1 - 1 / 1.2^2)^2 = 0.67, above the 0.63 that there is
/// elsewhere; at 1.1 cells are still closed, but it falls to 0.54.
constexpr float kRimOverlap = 1.2f;

/// Farthest corner that counts, in local spacings: what is open further than that is a border or a hole
/// of the scan, which stays. Among points spread at random, the least even sampling there is, an empty circle of radius
/// r spacings has the probability exp(-pi r^2): at 2 it is 3e-6.
constexpr float kCapSpacings = 2;

/// A point's spacing may exceed the median of its neighbours this many times before it counts as a lone point; where
/// density jumps it is real.
constexpr float kLoneSpacings = 4;

/// A corner further away than this, in local spacings, may lie beyond the border of the scan, where the bisectors of
/// neighbours along it meet. On a grid corners are 0.71 away, among random points the farthest of a cell 1.0 at the
/// median.
constexpr float kSureSpacings = 1;

/// Where even distances vanish: finer than the positions of a cloud whose extent is about 1.
constexpr float kMinRadius = 0x1p-24f;

/// Radii above kLimit times the kLimitShare quantile shrink to that: it touches one point in a thousand at most, so
/// that a sparse part of a scan keeps its discs. Measured on airborne, indoor and statue scans, whose largest radius is
/// 3 to 9 times that quantile: those few discs hid what lay behind them.
constexpr float kLimit = 1.5f;
constexpr double kLimitShare = 0.999;
/// With fewer points a thousandth of them says nothing.
constexpr std::size_t kMinLimitPoints = 10000;

struct RadiusJob {
    const Points& points;
    const NeighborLists& lists;
    const NearestSearch& search;
    const std::vector<float>& sheets; ///< sheetShares, or empty: all are
    bool oriented;
};

/// Tangent plane of a point.
struct TangentPlane {
    Vec3f origin, u, v, normal;

    TangentPlane(const Vec3f& position, const Vec3f& unit_normal)
        : origin(position), u(unit_normal.unitOrthogonal()), v(unit_normal.cross(u)), normal(unit_normal) {}

    Eigen::Vector2f project(const Vec3f& offset) const { return {u.dot(offset), v.dot(offset)}; }
    Vec3f at(const Eigen::Vector2f& place) const { return origin + u * place.x() + v * place.y(); }
};

/// The point's spacing, from the median of its neighbours' to kLoneSpacings times that. Most points are in between,
/// which counting tells without the median.
float commonSpacing(const NeighborLists& lists, std::size_t point, std::vector<float>& others) {
    const float own = lists.spacings[point];
    others.clear();
    for (const std::uint32_t neighbor : lists.of(point)) others.push_back(lists.spacings[neighbor]);
    std::size_t not_above = 0, far_below = 0;
    for (const float other : others) {
        not_above += other <= own;
        far_below += kLoneSpacings * other < own;
    }
    const std::size_t half = others.size() / 2;
    if (not_above > half && far_below <= half) return own;
    const auto median = others.begin() + std::ptrdiff_t(half);
    std::nth_element(others.begin(), median, others.end());
    return std::clamp(own, *median, kLoneSpacings * *median);
}

/// Whether two points lie on opposite sheets of something thin: normals further apart than any edge folds them.
bool onOtherSheet(const RadiusJob& job, std::size_t point, std::uint32_t other) {
    constexpr float kBackToBack = -0.5f; // 120 degrees: an edge as sharp as 60 degrees still joins its faces
    return job.oriented && job.points.normals[point].dot(job.points.normals[other]) < kBackToBack;
}

bool clipBy(const RadiusJob& job, std::size_t point, std::uint32_t other, const TangentPlane& plane,
            VoronoiCell& cell) {
    if (onOtherSheet(job, point, other)) return false;
    const Vec3f offset = job.points.positions[other] - plane.origin;
    return cell.clip(plane.project(offset), plane.normal.dot(offset));
}

void clipByNeighbors(const RadiusJob& job, std::size_t point, const TangentPlane& plane, VoronoiCell& cell) {
    float reach = cell.reach();
    for (const std::uint32_t neighbor : job.lists.of(point)) {
        if (distanceBetween(plane.origin, job.points.positions[neighbor]) >= 2 * reach) return;
        if (clipBy(job, point, neighbor, plane, cell)) reach = cell.reach();
    }
}

/// Clips by a point nearer to the corner than the cell's own, if there is one. A few candidates, because the nearest
/// may be on another sheet.
bool clipAtCorner(const RadiusJob& job, std::size_t point, const TangentPlane& plane, VoronoiCell& cell,
                  const Eigen::Vector2f& corner) {
    std::array<std::uint32_t, 4> candidates;
    std::array<float, 4> squared;
    const std::size_t found = job.search.nearest(plane.at(corner), candidates, squared, corner.squaredNorm());
    for (std::size_t i = 0; i < found; ++i)
        if (candidates[i] != point && clipBy(job, point, candidates[i], plane, cell)) return true;
    return false;
}

/// Makes the cell exact where the neighbours on the list do not reach: they are all there is within completeReach,
/// so that a corner is settled when the circle round it through the point stays inside.
void verifyCorners(const RadiusJob& job, std::size_t point, const TangentPlane& plane, VoronoiCell& cell) {
    const float settled = job.lists.completeReach(job.points, point) / 2;
    int clips_left = 64; // far more than a cell has edges: only rounding could ask for more
    for (std::size_t i = 0; i < cell.corners().size();) {
        const CellCorner corner = cell.corners()[i];
        const bool known = corner.verified || corner.place.norm() <= settled;
        if (!known && clips_left > 0 && clipAtCorner(job, point, plane, cell, corner.place)) {
            --clips_left;
            i = 0;
            continue;
        }
        cell.markVerified(i++);
    }
}

/// Whether the surface goes on behind a corner of the point's cell, so that the corner is in a gap and not beyond a
/// border: a point lies in the ball behind it that is as wide as the way to it. Of that, 1.91 times the way squared
/// lies outside the empty circle through the cell's point and the corner's two others: among points spread at random it
/// is empty for exp(-1.91) = 15% of the corners one spacing away, for all three in their directions 0.3%. A few
/// candidates, because the nearest may be on another sheet.
bool goesOnBehind(const RadiusJob& job, std::size_t point, const TangentPlane& plane, const Eigen::Vector2f& corner) {
    std::array<std::uint32_t, 4> found;
    std::array<float, 4> squared;
    const std::size_t count = job.search.nearest(plane.at(2 * corner), found, squared, corner.squaredNorm());
    return std::any_of(found.begin(), found.begin() + std::ptrdiff_t(count),
                       [&](std::uint32_t other) { return other != point && !onOtherSheet(job, point, other); });
}

/// Distance to the farthest corner that the disc is to reach.
float closedReach(const RadiusJob& job, std::size_t point, const TangentPlane& plane, const VoronoiCell& cell,
                  float cap) {
    const float sure = kSureSpacings / kCapSpacings * cap;
    return cell.closedReach(cap, [&](const Eigen::Vector2f& corner) {
        return corner.squaredNorm() <= sure * sure || goesOnBehind(job, point, plane, corner);
    });
}

/// How far the disc may reach in its plane before it sticks out of a ridge: distance to the nearest line where the
/// plane meets that of a neighbour across an edge; infinite without one. Valleys do not count where sides are known:
/// what reaches into the other face is hidden.
float ridgeDistance(const RadiusJob& job, std::size_t point, const TangentPlane& plane, float closing) {
    // Cosine of 37 degrees, where the averaging of normals stops too: noise has been averaged away, edges are left.
    constexpr float kCrease = 0.8f;
    float nearest = std::numeric_limits<float>::infinity();
    for (const std::uint32_t neighbor : job.lists.of(point)) {
        const Vec3f offset = job.points.positions[neighbor] - plane.origin;
        if (offset.squaredNorm() >= 4 * closing * closing) break;
        const Vec3f& other = job.points.normals[neighbor];
        const float cosine = other.dot(plane.normal);
        if (std::abs(cosine) >= kCrease || (job.oriented && plane.normal.dot(offset) > 0)) continue;
        nearest = std::min(nearest, std::abs(other.dot(offset)) / std::sqrt(1 - cosine * cosine));
    }
    return nearest;
}

/// Of half the way to the second neighbour, how wide the disc of a point is that is scattered in space. Of the lines of
/// sight through the crowns of three simulated scans 44, 38 and 50% pass; between such discs 30, 33 and 36% at 1, 40,
/// 35 and 44% at 0.6, 44, 36 and 48% at 0.5.
constexpr float kScattered = 0.5f;

/// The radius of a point that a surface holds together only in part.
float towardsAlone(float radius, float half_way, float sheet) {
    const float alone = std::min(radius, kScattered * half_way);
    return sheet < 1 ? alone + sheet * (radius - alone) : radius;
}

/// Whether a point and a few others stand far from all the rest: what lies between such groups nothing sampled. From
/// the sixth neighbour to the 16th a surface reaches 1.6 times as far and a line 2.7 times, to the ninth 1.2 and 1.5
/// times; at 3.3 and 2.2 times single clumps among random samples of a torus stood apart.
bool standsApart(const RadiusJob& job, std::size_t point) {
    constexpr std::size_t kGroup = 6, kNear = 9, kFar = 16;
    if (job.lists.k < kFar) return false;
    const bool thinned = job.lists.thinned[point]; // of which the first half lists all there are
    const float apart = thinned ? 3.0f : 5.0f;
    return job.lists.distance(job.points, point, (thinned ? kNear : kFar) - 1) >
           apart * job.lists.distance(job.points, point, kGroup - 1);
}

float discRadius(const RadiusJob& job, std::size_t point, VoronoiCell& cell, std::vector<float>& scratch) {
    const TangentPlane plane(job.points.positions[point], job.points.normals[point]);
    const float cap = kCapSpacings * commonSpacing(job.lists, point, scratch);
    cell.reset(cap);
    clipByNeighbors(job, point, plane, cell);
    verifyCorners(job, point, plane, cell);
    // Points along a line have no closed corner: half way to the second neighbour covers the line.
    const std::size_t second = std::min<std::size_t>(1, job.lists.k - 1);
    const float half_way = std::max(std::min(job.lists.distance(job.points, point, second) / 2, cap), kMinRadius);
    const float closed = closedReach(job, point, plane, cell, cap);
    const float widest = kOverlap * std::max(closed, half_way);
    const float least = std::max(kRimOverlap * closed, kOverlap * half_way);
    const float radius =
        cell.isOpen() ? least : std::clamp(ridgeDistance(job, point, plane, widest / kOverlap), least, widest);
    const float held = job.sheets.empty() ? radius : towardsAlone(radius, half_way, job.sheets[point]);
    return standsApart(job, point) ? std::min(held, kOverlap * half_way) : held;
}

} // namespace

std::vector<float> discRadii(const Points& points, const NeighborLists& lists, const NearestSearch& search,
                             const std::vector<float>& sheets, bool oriented, const StageShare& share) {
    const RadiusJob job{points, lists, search, sheets, oriented};
    std::vector<float> radii(points.size());
    forRanges(points.size(), share, [&](std::size_t begin, std::size_t end) {
        VoronoiCell cell;
        std::vector<float> scratch;
        for (std::size_t i = begin; i < end; ++i) radii[i] = discRadius(job, i, cell, scratch);
    });
    return radii;
}

void shrinkPlates(std::vector<float>& radii, const Points& points, const NeighborLists& lists) {
    // Of the median of its neighbours' radii a radius of a raw range scan or an airborne survey of houses is 1.6
    // and 1.4 times in 99 of 100 places, one in two of more than 10 cm in trees 10 m high is 2.4 times. Only where
    // neighbours stand a tenth of their reach over the plane: beside a change of density a surface has such radii, too.
    constexpr float kPlate = 1.7f, kUneven = 0.1f;
    const std::vector<float> before = radii;
    tbb::parallel_for(std::size_t(0), radii.size(), [&](std::size_t i) {
        const auto neighbors = lists.of(i);
        const auto narrow = std::count_if(neighbors.begin(), neighbors.end(),
                                          [&](std::uint32_t other) { return kPlate * before[other] < before[i]; });
        if (2 * std::size_t(narrow) <= neighbors.size()) return;
        if (heightOver(points, lists, i) <= kUneven * lists.reach(points, i)) return;
        std::vector<float> around;
        for (const std::uint32_t neighbor : neighbors) around.push_back(before[neighbor]);
        radii[i] = medianInPlace(around);
    });
}

void tightenSmoothed(std::vector<float>& radii, const std::vector<float>& noise) {
    // An overlap of 1.2 instead of 1.4. Of the raw Dragon's outline the share shared with the true one goes from 0.968
    // to 0.973, holes from 108 to 226 a million; at 1.1 those are 272, and nothing is won.
    constexpr float kSmoothed = kRimOverlap / kOverlap;
    for (std::size_t i = 0; i < noise.size(); ++i)
        if (noise[i] > 0) radii[i] *= kSmoothed;
}

std::optional<RadiusLimitRule> radiusLimitRule(std::size_t count) {
    if (count < kMinLimitPoints) return std::nullopt;
    return RadiusLimitRule{std::size_t(kLimitShare * double(count)), kLimit};
}

float radiusLimit(std::vector<float>& radii) {
    const auto rule = radiusLimitRule(radii.size());
    if (!rule) return std::numeric_limits<float>::infinity();
    const auto at = radii.begin() + std::ptrdiff_t(rule->place);
    std::nth_element(radii.begin(), at, radii.end());
    return rule->times * *at;
}

void limitRadii(std::vector<float>& radii, std::optional<float> decided) {
    std::vector<float> sorted = decided ? std::vector<float>() : radii;
    const float limit = decided ? *decided : radiusLimit(sorted);
    for (float& radius : radii) radius = std::min(radius, limit);
}

} // namespace pointrt::surface

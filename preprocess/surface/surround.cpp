// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/surround.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/plane_fit.h"
#include "preprocess/surface/thinned_cloud.h"

namespace pointrt::surface {
namespace {

/// With fewer neighbours, random ones are on one side too often.
constexpr std::size_t kFewestToSurround = 8;

/// A list is elongated if its points spread so much further along a line than across it that (b + c) / a is below this,
/// for eigenvalues a >> b, c of the covariance: of 16 random neighbours on a surface, 1 list in 200 is.
constexpr double kElongated = 0.2;

/// A list is clumpy if its last neighbour is so many times as far as its sixth: 1.6 times on a surface, 2.7 on a line.
constexpr float kClumpy = 3;
constexpr std::size_t kInClump = 6;

/// A list is off-centre if the mean is so far from the point, over the distance to the last neighbour: 0.42 at a
/// straight border, more for 1 in 50 random points.
constexpr float kOffCenter = 0.35f;

/// A clump is isolated if nothing is between 1.5 and this many times the distance to its last neighbour: a surface has
/// points all over it.
constexpr float kAlone = 3;
constexpr float kBeyondClump = 1.5f;

/// Representatives examined at a level: within 2.4 cell edges on a plane, so that there are two rings.
constexpr std::size_t kExamined = 24;

/// Widest empty angle around a point that is surrounded. Among 24 random points, it is above this for one in 10,000;
/// at a border it is half a turn.
constexpr float kWidestGap = 2 * std::numbers::pi_v<float> / 3;

/// Levels searched after the first one that spans a plane, for what fills the remaining gap: four times as far.
constexpr std::size_t kMoreLevels = 2;

/// What is conspicuous about a point's nearest neighbours.
enum Suspicion : std::uint8_t {
    kUnsuspected,
    kOneSided, ///< they are off-centre, or so are those of some neighbours: a border, or a clump
    kSprawling ///< they are elongated or clumpy
};

bool isElongated(const Moments& moments) {
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    const double trace = double(xx) + yy + zz;
    const double invariant =
        double(xx) * yy + double(xx) * zz + double(yy) * zz - double(xy) * xy - double(xz) * xz - double(yz) * yz;
    return invariant < kElongated * trace * trace;
}

Suspicion suspicionOf(const NeighborLists& lists, const PointSet& points, std::size_t point) {
    const Moments moments = momentsOf(points, lists.of(point), point);
    const float radius = lists.radius(points, point);
    if (isElongated(moments) || radius > kClumpy * lists.distance(points, point, kInClump - 1)) return kSprawling;
    return moments.mean.norm() > kOffCenter * radius ? kOneSided : kUnsuspected;
}

/// The suspicion of each point. Suspects the neighbours of one-sided points, too: in the middle of a clump, the nearest
/// neighbours are all around.
std::vector<std::uint8_t> suspect(const NeighborLists& lists, const PointSet& points, const StageShare& share) {
    std::vector<std::uint8_t> own(points.size());
    forEach(points.size(), share, [&](std::size_t i) { own[i] = suspicionOf(lists, points, i); });
    std::vector<std::uint8_t> all = own;
    const StageProgress silent;
    forEach(points.size(), {silent, ""}, [&](std::size_t i) {
        if (own[i] != kUnsuspected) return;
        const auto neighbors = lists.of(i);
        const auto count = std::count_if(neighbors.begin(), neighbors.end(),
                                         [&](std::uint32_t neighbor) { return own[neighbor] != kUnsuspected; });
        if (std::size_t(count) >= lists.k / 4) all[i] = kOneSided;
    });
    return all;
}

/// Points around a point, in its plane.
struct Around {
    bool is_plane = false;
    float widest_gap = 0;            ///< angle
    std::vector<std::uint32_t> near; ///< nearest first; those in different directions before the others
    float reach = 0;                 ///< distance to the farthest of those in different directions
};

struct Direction {
    float angle = 0, distance = 0;
    std::uint32_t point = 0;
};

float widestGap(const std::vector<Direction>& directions) {
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    if (directions.empty()) return kTurn;
    std::vector<float> angles;
    for (const Direction& direction : directions) angles.push_back(direction.angle);
    std::sort(angles.begin(), angles.end());
    float widest = angles.front() + kTurn - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    return widest;
}

/// Takes the nearest points at least a tenth of a turn from each other, then the others.
void selectAround(const std::vector<Direction>& directions, Around& around) {
    constexpr float kApart = std::numbers::pi_v<float> / 5, kTurn = 2 * std::numbers::pi_v<float>;
    std::vector<Direction> taken;
    std::vector<std::uint32_t> others;
    for (const Direction& direction : directions) {
        const bool apart = std::all_of(taken.begin(), taken.end(), [&](const Direction& other) {
            const float between = std::abs(other.angle - direction.angle);
            return std::min(between, kTurn - between) >= kApart;
        });
        if (apart)
            taken.push_back(direction);
        else
            others.push_back(direction.point);
    }
    for (const Direction& direction : taken) around.near.push_back(direction.point);
    around.reach = taken.empty() ? 0 : taken.back().distance;
    around.near.insert(around.near.end(), others.begin(), others.end());
}

/// A search for the neighbourhood of one point.
struct SurroundSearch {
    const NeighborLists& lists;
    const PointSet& points;
    const ThinnedCloud& thinned;
    std::array<std::uint32_t, kExamined> found;
    std::array<float, kExamined> squared;

    /// Finds the representatives of a level next to a point; returns their number.
    std::size_t find(const ThinnedLevel& level, std::size_t point) {
        return level.search.nearest(points.positions[point], found, squared);
    }
    Around examine(const ThinnedLevel& level, std::size_t point, float nearest);
    bool isIsolated(std::size_t point);
    std::optional<Around> surround(std::size_t point, bool uneven);
};

/// The representatives of a level around a point, without those nearer than `nearest`, whose directions are noise.
Around SurroundSearch::examine(const ThinnedLevel& level, std::size_t point, float nearest) {
    const std::size_t count = find(level, point);
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(level.points[found[i]]);
    Around around;
    const Moments moments = momentsOf(points, all, point);
    around.is_plane = !isElongated(moments);
    if (!around.is_plane) return around;
    const Vec3f normal = fitPlane(moments).normal, u = normal.unitOrthogonal(), v = normal.cross(u);
    std::vector<Direction> directions;
    for (const std::uint32_t other : all) {
        const Vec3f offset = points.positions[other] - points.positions[point];
        const float x = u.dot(offset), y = v.dot(offset), distance = std::hypot(x, y);
        if (distance > nearest) directions.push_back({std::atan2(y, x), distance, other});
    }
    around.widest_gap = widestGap(directions);
    selectAround(directions, around);
    return around;
}

/// Whether a point and its neighbours are a clump with nothing around.
bool SurroundSearch::isIsolated(std::size_t point) {
    const float radius = lists.radius(points, point);
    const std::size_t number = thinned.levelFor(radius / 2);
    if (number >= thinned.levelCount()) return false;
    const std::size_t count = find(thinned.level(number), point);
    for (std::size_t i = 0; i < count; ++i)
        if (squared[i] > kBeyondClump * kBeyondClump * radius * radius)
            return squared[i] > kAlone * kAlone * radius * radius;
    return false;
}

/// The points that surround a point, or those at a border; nothing if the nearest neighbours will do.
std::optional<Around> SurroundSearch::surround(std::size_t point, bool uneven) {
    if (!uneven && !isIsolated(point)) return {};
    const float radius = lists.radius(points, point);
    const std::size_t first = thinned.levelFor(radius / 2);
    std::optional<Around> border;
    std::size_t end = thinned.levelCount();
    for (std::size_t number = first; number < end; ++number) {
        const ThinnedLevel& level = thinned.level(number);
        Around around = examine(level, point, uneven ? level.edge / 2 : std::max(radius, level.edge / 2));
        if (!around.is_plane || around.near.size() < lists.k - lists.denseCount()) continue;
        if (around.widest_gap < kWidestGap) return around;
        if (border) continue;
        border = std::move(around);
        end = std::min(end, number + kMoreLevels + 1);
    }
    return border;
}

/// Puts the points around in place of the farther half of a list.
void adopt(NeighborLists& lists, const PointSet& points, std::size_t point, const Around& around) {
    std::uint32_t* const list = &lists.indices[point * lists.k];
    const std::size_t dense = lists.denseCount();
    std::vector<std::uint32_t> others;
    for (const std::uint32_t other : around.near)
        if (std::find(list, list + dense, other) == list + dense) others.push_back(other);
    others.resize(std::min(others.size(), lists.k - dense));
    const auto distance = [&](std::uint32_t other) {
        return squaredDistance(points.positions[other], points.positions[point]);
    };
    std::sort(others.begin(), others.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(distance(a), a) < std::pair(distance(b), b); });
    // the farthest stays last, as it tells the radius of the neighbourhood
    std::copy(others.begin(), others.end(), list + (lists.k - others.size()));
    constexpr float kSpacings = 2; // of the distance to the farthest point around: no wider is what separates them
    lists.spacings[point] = around.reach / kSpacings;
    lists.thinned[point] = around.widest_gap < kWidestGap ? kSurrounded : kAtBorder;
}

/// The wanted edge of the finest cells: those for the smallest lists to replace, but for a few.
float finestEdge(const NeighborLists& lists, const PointSet& points, const std::vector<std::uint8_t>& suspicions) {
    constexpr double kAllButFew = 0.02;
    std::vector<float> radii;
    for (std::size_t i = 0; i < suspicions.size(); ++i)
        if (suspicions[i] != kUnsuspected) radii.push_back(lists.radius(points, i));
    return radii.empty() ? 0 : quantileOf(std::move(radii), kAllButFew) / 2;
}

} // namespace

void surroundNeighborhoods(NeighborLists& lists, const PointSet& points, const StageShare& share) {
    if (lists.k < kFewestToSurround) return;
    const double middle = (share.from + share.to) / 2;
    const std::vector<std::uint8_t> suspicions =
        suspect(lists, points, {share.progress, share.stage, share.from, middle});
    const float edge = finestEdge(lists, points, suspicions);
    if (!(edge > 0)) return;
    const ThinnedCloud thinned(points, edge);
    const NeighborLists before = lists;
    forRanges(points.size(), {share.progress, share.stage, middle, share.to}, [&](std::size_t begin, std::size_t end) {
        SurroundSearch search{before, points, thinned, {}, {}};
        for (std::size_t i = begin; i < end; ++i) {
            if (suspicions[i] == kUnsuspected) continue;
            if (const auto around = search.surround(i, suspicions[i] == kSprawling)) adopt(lists, points, i, *around);
        }
    });
}

} // namespace pointrt::surface

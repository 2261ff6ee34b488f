// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/surround.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <tbb/parallel_for.h>

#include "preprocess/cloud/median.h"
#include "preprocess/cloud/per_thread.h"
#include "preprocess/surface/angle_gaps.h"
#include "preprocess/surface/nearest_cache.h"
#include "preprocess/surface/plane_fit.h"
#include "preprocess/surface/suspicion.h"
#include "preprocess/surface/thinned_cloud.h"

namespace pointrt::surface {
namespace {

/// With fewer neighbours, random ones are on one side too often.
constexpr std::size_t kFewestToSurround = 8;

/// A list that may be on a line counts as one if the lists of an eighth of its neighbours are on a line, too; any list
/// counts if those of a quarter are.
constexpr std::size_t kPartForElongated = 8, kPartForAny = 4;

/// Points around are on a surface if the misfit of their plane is below this: 0 on a plane, more than 0.2 for all but 1
/// in 100 sets of 24 points scattered in space, as the leaves of a crown are, and 0.25 for two sheets as far apart as
/// two thirds of their radius. Lines are sparser than clumps, so that their surroundings are less flat for the same
/// reason.
constexpr float kFlatAroundLine = 0.1f, kFlatAroundClump = 0.2f;

/// In noisy clouds, neighbours with a larger misfit are in no plane: the normal of 16 of them is then off by about
/// sqrt(0.1 / 16), 5 degrees.
constexpr float kInNoPlane = 0.1f;
/// In noise, the search for points around goes up to the level at which the misfit falls below this: normals of 24
/// points are then off by about sqrt(0.05 / 24), 3 degrees. Searching four levels suffices for noise of up to 8 list
/// radii.
constexpr float kFlatInNoise = 0.05f;
constexpr std::size_t kNoiseLevels = 4;
/// Edges and corners of rooms have misfits of 0.25 to 0.45. Such a misfit is accepted, and so is a border, if this
/// share of the points around have found a surface like that.
constexpr float kCorner = 0.5f;
constexpr double kShareOnSurface = 1.0 / 3;
/// If fewer points of the cloud than this are in corners, their lists look that way by chance and none counts as in a
/// corner.
constexpr double kShareToCount = 1.0 / 50;

/// Levels at which a point counts as isolated (ThinnedCloud): those whose cells are as wide as its list, or twice as
/// wide, which suits clumps of up to a hundred points. At coarser levels small objects would be clumps, and whole scans
/// lines.
constexpr std::size_t kIsolationLevels = 2;

/// Representatives examined at a level: within 2.4 cell edges on a plane, so that there are two rings.
constexpr std::size_t kExamined = 24;

/// Widest empty angle around a surrounded point. 24 random points exceed it once in 10,000; at a border the angle is
/// half a turn.
constexpr float kWidestGap = 2 * std::numbers::pi_v<float> / 3;

/// Levels searched after the first one that spans a plane, for what fills the remaining gap: four times as far.
constexpr std::size_t kMoreLevels = 2;

/// In clouds of at least kManyPoints points, every 16th list is enough for shares of a hundredth and for quantiles.
constexpr std::size_t kSampleStep = 16, kManyPoints = 16384;
/// Every fourth of these is probed.
constexpr std::size_t kProbeStep = 4;

/// Points around a point, in its plane.
struct Around {
    float misfit = 0;                  ///< misfit of their plane; infinite if they are on a line
    Vec3f normal = Vec3f::Zero();      ///< normal of their plane, if that fits
    std::uint8_t flags = 0;            ///< bits of ListFlag
    float widest_gap = 0;              ///< an angle
    std::vector<std::uint32_t> points; ///< nearest first; those in different directions before the others
    float reach = 0;                   ///< distance within which points already leave no wider gap
    bool keeps_spacing = false;        ///< the distances do not say how wide discs must be
};

struct Direction {
    float angle = 0, distance = 0;
    std::uint32_t point = 0;
};

/// Finds the widest gap, and the distance of the first points that leave no wider one. At a border there is one wide
/// gap; on a line there are two.
void measureGap(const std::vector<Direction>& directions, Around& around) {
    constexpr float kAsWide = 1.1f;
    std::vector<float> angles;
    for (const Direction& direction : directions) angles.push_back(direction.angle);
    std::sort(angles.begin(), angles.end());
    around.widest_gap = gapsBetween(angles).widest;
    const float narrow = std::max(kWidestGap, kAsWide * around.widest_gap);
    angles.clear();
    for (const Direction& direction : directions) {
        angles.insert(std::upper_bound(angles.begin(), angles.end(), direction.angle), direction.angle);
        around.reach = direction.distance;
        const EmptyAngles gaps = gapsBetween(angles);
        if (gaps.widest < narrow && gaps.second < kWidestGap) return;
    }
}

/// Takes the nearest points that are at least a tenth of a turn apart, then the others.
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
    for (const Direction& direction : taken) around.points.push_back(direction.point);
    around.points.insert(around.points.end(), others.begin(), others.end());
}

/// How to search for the points around a point.
struct SurroundPlan {
    Suspicion suspicion = Suspicion::kUnsuspected;
    std::size_t level = 0; ///< the finest level to search
    float least = 0;       ///< distance below which directions are noise
};

/// What the search for neighbourhoods needs. One object per thread.
struct SurroundSearch {
    const NeighborLists& lists;
    const PointSet& points;
    const NearestSearch& nearest;
    const ThinnedCloud& thinned;
    const std::vector<std::uint32_t>& isolated; ///< ThinnedCloud::findIsolated
    const std::vector<Suspicion>& suspicions;   ///< of the nearest neighbours
    std::span<const std::uint8_t> found_before; ///< NeighborLists::thinned after the first round; empty in the first
    std::vector<std::uint32_t>& hopeless; ///< [points] set in the first round; bit n: level n has not even a corner
    std::vector<std::optional<NearestCache>>& caches; ///< [levels] of this thread
    std::array<std::uint32_t, kExamined> found{};
    std::array<float, kExamined> squared{};

    Around examine(std::size_t point, std::span<const std::uint32_t> others, float least, float misfit) const;
    Around examineLevel(std::size_t number, std::size_t point, float least, float misfit);
    std::optional<std::size_t> isolatedLevel(std::size_t point) const;
    bool isBetter(const Around& around, Suspicion suspicion) const;
    bool liesInPlane(std::size_t point, const Around& around) const;
    bool isAmongFound(std::size_t point, bool maybe) const;
    SurroundPlan plan(std::size_t point) const;
    std::optional<Around> surround(std::size_t point);
    std::optional<Around> surroundInNoise(std::size_t point, const SurroundPlan& plan);
    std::optional<Around> acrossGap(std::size_t point, const SurroundPlan& plan);
    std::optional<std::uint32_t> nearestOther(std::size_t point, const Vec3f& offset, float farthest) const;
    std::vector<std::uint32_t> straightAcross(std::size_t point, const Vec3f& along, const Around& around) const;
    void turnAcross(std::size_t point, Around& around) const;
};

Vec3f longestAxis(const Moments& moments) {
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    Eigen::Matrix3d matrix;
    matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(matrix);
    return solver.eigenvectors().col(2).cast<float>();
}

/// Other points around a point, except those nearer than `least`, whose directions are noise. Empty if the misfit of
/// their plane exceeds `misfit`: most points of crowns are searched at all levels without finding a plane.
Around SurroundSearch::examine(std::size_t point, std::span<const std::uint32_t> others, float least,
                               float misfit) const {
    Around around;
    const Moments moments = momentsOf(points, others, point);
    around.misfit = isOnLine(moments) ? std::numeric_limits<float>::infinity() : misfitOf(moments);
    if (!(around.misfit < misfit)) return around;
    const PlaneFit plane = fitPlane(moments);
    around.normal = plane.normal;
    const Vec3f u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    std::vector<Direction> directions;
    for (const std::uint32_t other : others) {
        const Vec3f offset = points.positions[other] - points.positions[point];
        const float x = u.dot(offset), y = v.dot(offset), distance = std::hypot(x, y);
        if (distance > least) directions.push_back({std::atan2(y, x), distance, other});
    }
    measureGap(directions, around);
    selectAround(directions, around);
    return around;
}

/// The representatives of a level around a point.
Around SurroundSearch::examineLevel(std::size_t number, std::size_t point, float least, float misfit) {
    const ThinnedLevel& level = thinned.level(number);
    if (!caches[number]) caches[number].emplace(level.search, level.positions);
    const std::size_t count = caches[number]->nearest(points.positions[point], found, squared);
    for (std::size_t i = 0; i < count; ++i) found[i] = level.points[found[i]];
    return examine(point, {found.data(), count}, std::max(least, level.edge / 2), misfit);
}

/// The coarsest level at which the point is isolated.
std::optional<std::size_t> SurroundSearch::isolatedLevel(std::size_t point) const {
    const std::size_t finest = thinned.levelFor(lists.radius(points, point));
    for (std::size_t number = finest + kIsolationLevels; number-- > finest;)
        if (number < thinned.levelCount() && (isolated[point] >> number & 1)) return number;
    return {};
}

/// The misfit below which points around are on a surface.
float flatFor(Suspicion suspicion) { return suspicion == Suspicion::kOnLine ? kFlatAroundLine : kFlatAroundClump; }

/// Whether points around may replace a list.
bool SurroundSearch::isBetter(const Around& around, Suspicion suspicion) const {
    const bool open = around.flags & kOpen;
    if (!open && around.misfit < flatFor(suspicion)) return true;
    if (found_before.empty() || !(around.misfit < kCorner)) return false;
    const auto on_surface = std::count_if(around.points.begin(), around.points.end(),
                                          [&](std::uint32_t other) { return found_before[other] != 0; });
    return double(on_surface) >= kShareOnSurface * double(around.points.size());
}

/// Whether the list of a point on a line lies in the plane of the points around it. Arcs of several beams on a post or
/// a trunk form a line, too, but the planes of the ground and of other posts stand across it.
bool SurroundSearch::liesInPlane(std::size_t point, const Around& around) const {
    constexpr float kSteep = 0.8f;     // sine of 53 degrees: at a crease, the plane lies between both faces
    constexpr float kFar = 0.4f;       // of the list's radius: the directions to nearer points are noise
    constexpr std::size_t kFewOff = 8; // up to one point in 8 may leave the plane
    const float far = kFar * lists.radius(points, point);
    const auto list = lists.of(point);
    const auto off = std::count_if(list.begin(), list.end(), [&](std::uint32_t other) {
        const Vec3f offset = points.positions[other] - points.positions[point];
        const float distance = offset.norm();
        return distance >= far && std::abs(around.normal.dot(offset)) > kSteep * distance;
    });
    return kFewOff * std::size_t(off) <= list.size();
}

/// Whether enough neighbours of a point were on lines or in clumps. @param maybe the point's own may be, too
bool SurroundSearch::isAmongFound(std::size_t point, bool maybe) const {
    if (found_before.empty()) return false;
    const auto neighbors = lists.of(point);
    const auto count = std::count_if(neighbors.begin(), neighbors.end(),
                                     [&](std::uint32_t other) { return found_before[other] != 0; });
    return (maybe ? kPartForElongated : kPartForAny) * std::size_t(count) >= neighbors.size();
}

SurroundPlan SurroundSearch::plan(std::size_t point) const {
    const float radius = lists.radius(points, point);
    const Suspicion own = suspicions[point];
    if (own == Suspicion::kInNoise) return {own, thinned.levelFor(radius), radius};
    if (const auto level = isolatedLevel(point); level && own != Suspicion::kOnLine)
        return {Suspicion::kAlone, *level, radius};
    if (own >= Suspicion::kOnLine && own != Suspicion::kOnOneSide) return {own, thinned.levelFor(radius / 2), 0};
    if (isAmongFound(point, own == Suspicion::kMaybeLine))
        return {Suspicion::kOnLine, thinned.levelFor(radius), radius};
    if (own == Suspicion::kOnOneSide) return {own, thinned.levelFor(radius), radius};
    return {};
}

/// The points that surround a point at the scale that its noise allows.
std::optional<Around> SurroundSearch::surroundInNoise(std::size_t point, const SurroundPlan& plan) {
    std::optional<Around> best;
    const std::size_t end = std::min(thinned.levelCount(), plan.level + kNoiseLevels);
    for (std::size_t number = plan.level; number < end; ++number) {
        Around around = examineLevel(number, point, plan.least, kFlatAroundClump);
        around.flags = std::uint8_t(kThinned | kClump | (around.widest_gap < kWidestGap ? 0 : kOpen));
        const float flat = (around.flags & kOpen) ? kInNoPlane : kFlatAroundClump;
        if (around.points.size() < lists.k - lists.denseCount() || !(around.misfit < flat)) continue;
        const bool closes = best && best->misfit < kFlatInNoise && (best->flags & kOpen);
        if (closes && (around.flags & kOpen)) continue;
        if (closes) around.flags |= kAtGap;
        if (!best || closes || around.misfit < best->misfit) best = std::move(around);
        if (best->misfit < kFlatInNoise && !(best->flags & kOpen)) break;
    }
    if (best) best->keeps_spacing = (best->flags & kOpen) && best->misfit >= kFlatInNoise;
    return best;
}

/// The points that surround a point at the edge of a gap; nothing if it is at a border.
std::optional<Around> SurroundSearch::acrossGap(std::size_t point, const SurroundPlan& plan) {
    const std::size_t end = std::min(thinned.levelCount(), plan.level + kMoreLevels + 1);
    for (std::size_t number = plan.level; number < end; ++number) {
        Around around = examineLevel(number, point, plan.least, kFlatAroundLine);
        if (around.points.size() < lists.k - lists.denseCount() || !(around.misfit < kFlatAroundLine) ||
            !(around.widest_gap < kWidestGap))
            continue;
        around.flags = kThinned | kClump | kAtGap;
        return around;
    }
    return {};
}

/// The point nearest to a place beside a point, if it is another one and near enough to that place.
std::optional<std::uint32_t> SurroundSearch::nearestOther(std::size_t point, const Vec3f& offset,
                                                          float farthest) const {
    std::array<std::uint32_t, 1> other;
    std::array<float, 1> distance;
    const std::size_t count = nearest.nearest(points.positions[point] + offset, other, distance, farthest * farthest);
    if (count == 0 || other[0] == point) return {};
    return other[0];
}

/// Points of other lines, straight across from a point: those nearest to where its surroundings are when moved back
/// along the line. Nearest first, without a second one close to the first.
std::vector<std::uint32_t> SurroundSearch::straightAcross(std::size_t point, const Vec3f& along,
                                                          const Around& around) const {
    constexpr float kStraight = 0.25f; // of the distance across: 14 degrees
    const Vec3f from = points.positions[point];
    std::vector<std::uint32_t> found_across;
    for (const std::uint32_t start : around.points) {
        Vec3f offset = points.positions[start] - from;
        Vec3f across = offset - along.dot(offset) * along;
        const float apart = across.norm();
        if (apart < std::abs(along.dot(offset)) || apart < lists.radius(points, point)) continue;
        const auto other = nearestOther(point, across, apart / 2);
        if (!other) continue;
        offset = points.positions[*other] - from;
        across = offset - along.dot(offset) * along;
        if (std::abs(along.dot(offset)) > kStraight * across.norm() || across.norm() < apart / 2) continue;
        const bool is_new = std::none_of(found_across.begin(), found_across.end(), [&](std::uint32_t each) {
            return (points.positions[each] - points.positions[*other]).norm() < kStraight * apart;
        });
        if (is_new) found_across.push_back(*other);
    }
    return found_across;
}

/// For a point on a line, replaces the points around by those straight across, and by points of its own line that are
/// much nearer than those: how the surface bends along the line is known from there, and farther along it may be
/// another surface. If there is no other line, the distance of the points around does not count as spacing: the arc of
/// a single line lies in the plane of its beam, which is no surface.
void SurroundSearch::turnAcross(std::size_t point, Around& around) const {
    constexpr std::array<float, 4> kAlong{1.0f / 16, -1.0f / 16, 1.0f / 8, -1.0f / 8}; // of the distance across
    constexpr std::size_t kMostAcross = 3;
    // Nearer lines, as of a spinning lidar on walls, are hardly farther away than the points along the own: the points
    // around in all directions orient normals better.
    constexpr float kFarLine = 4;
    const Vec3f along = longestAxis(quickMoments(lists, points, point));
    std::vector<std::uint32_t> chosen = straightAcross(point, along, around);
    around.keeps_spacing = chosen.empty();
    if (chosen.size() < 2) return;
    const float gap = distanceBetween(points.positions[point], points.positions[chosen[0]]);
    if (gap < kFarLine * lists.completeRadius(points, point)) return;
    chosen.resize(std::min(chosen.size(), kMostAcross));
    const std::size_t across = chosen.size();
    for (const float share : kAlong)
        if (const auto other = nearestOther(point, share * gap * along, std::abs(share) * gap / 2))
            chosen.push_back(*other);
    if (chosen.size() + 1 >= across + kAlong.size()) around.flags |= kBesideGap;
    around.points = std::move(chosen);
}

/// The points that surround a point, or those at a border; empty if the nearest neighbours are good enough.
std::optional<Around> SurroundSearch::surround(std::size_t point) {
    const SurroundPlan planned = plan(point);
    const auto [suspicion, first_level, least] = planned;
    if (suspicion == Suspicion::kUnsuspected) return {};
    const bool searched_before = !found_before.empty(); // these two would find nothing new
    if (suspicion == Suspicion::kInNoise) return searched_before ? std::nullopt : surroundInNoise(point, planned);
    if (suspicion == Suspicion::kOnOneSide) return searched_before ? std::nullopt : acrossGap(point, planned);
    const std::uint8_t flags = kThinned | (suspicion >= Suspicion::kInClump ? kClump : 0);
    const auto take = [&, suspicion = suspicion](Around& around) {
        around.flags = std::uint8_t(flags | (around.widest_gap < kWidestGap ? 0 : kOpen));
        return around.points.size() >= lists.k - lists.denseCount() && isBetter(around, suspicion) &&
               (suspicion != Suspicion::kOnLine || liesInPlane(point, around));
    };
    // In the first round, isBetter accepts nothing else; in the second, also corners.
    const float misfit = found_before.empty() ? flatFor(suspicion) : kCorner;
    std::optional<Around> border;
    std::size_t end = thinned.levelCount();
    for (std::size_t number = first_level; number < end; ++number) {
        if (hopeless[point] >> number & 1) continue;
        Around around = examineLevel(number, point, least, misfit);
        if (!(around.misfit < kCorner)) hopeless[point] |= std::uint32_t(1) << number;
        if (!take(around)) continue;
        if (suspicion == Suspicion::kOnLine) turnAcross(point, around);
        if (!(around.flags & kOpen)) return around;
        if (border) continue;
        border = std::move(around);
        end = std::min(end, number + kMoreLevels + 1);
    }
    return border;
}

/// Replaces the farther half of a list by the points around, nearest first.
void adopt(NeighborLists& lists, const PointSet& points, std::size_t point, const Around& around) {
    std::uint32_t* const list = &lists.indices[point * lists.k];
    std::uint32_t* const second_half = list + lists.denseCount();
    std::vector<std::uint32_t> chosen(list, second_half);
    std::vector<std::uint32_t> wanted = around.points;
    wanted.insert(wanted.end(), second_half, list + lists.k);
    for (std::size_t i = 0; chosen.size() < lists.k; ++i)
        if (std::find(chosen.begin(), chosen.end(), wanted[i]) == chosen.end()) chosen.push_back(wanted[i]);
    std::sort(chosen.begin() + std::ptrdiff_t(lists.denseCount()), chosen.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3f& from = points.positions[point];
        return std::pair(squaredDistance(points.positions[a], from), a) <
               std::pair(squaredDistance(points.positions[b], from), b);
    });
    std::copy(chosen.begin(), chosen.end(), list);
    // If surrounding points at a distance r are less than a third of a turn apart, the Voronoi cell has a radius of at
    // most r.
    constexpr float kSpacings = 2; // most spacings in the radius of a cell (kCapSpacings in radii.cpp)
    if (!around.keeps_spacing) lists.spacings[point] = std::max(lists.spacings[point], around.reach / kSpacings);
    lists.thinned[point] = around.flags;
}

/// At a border, limits the spacing to that of the surrounded points around it: those of other lines or clumps. If there
/// are hardly any, the list was replaced by chance. Elsewhere a spacing is at most three times that of the points
/// around; otherwise a point in the open next to dense parts would become a plate.
void limitSpacings(NeighborLists& lists, const PointSet& points) {
    constexpr std::size_t kFew = 2;
    constexpr float kWider = 3;
    const std::vector<float> before = lists.spacings;
    const StageProgress silent;
    forEach(points.size(), {silent, ""}, [&](std::size_t i) {
        if (!lists.thinned[i] || (lists.thinned[i] & kAtGap)) return;
        const bool open = lists.thinned[i] & kOpen;
        std::vector<float> around;
        for (const std::uint32_t other : lists.of(i).subspan(lists.denseCount()))
            if (!open || (lists.thinned[other] && !(lists.thinned[other] & kOpen))) around.push_back(before[other]);
        const float own = spacingFromRadius(lists.distance(points, i, kClumpSize - 1), kClumpSize);
        const float limit = around.size() < kFew ? own : (open ? 1 : kWider) * medianInPlace(around);
        lists.spacings[i] = std::max(own, std::min(before[i], limit));
    });
}

/// Whether a list would still contain hardly more than a line or a clump if it were several times as wide.
bool isIsolated(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest, std::size_t point,
                std::vector<std::uint32_t>& found) {
    // Within 4.5 radii of a list there are 20 times as many points as on it; a quarter of that at a corner, 4.5 times
    // as many on a line.
    constexpr float kFarther = 4.5f;
    constexpr std::size_t kFewTimes = 5;
    found.resize(kFewTimes * lists.k);
    const float reach = kFarther * lists.radius(points, point);
    return nearest.within(points.positions[point], reach * reach, found) <= found.size();
}

/// Finds the points within a distance, or some thousand of them if there are more.
void findWithin(const PointSet& points, const NearestSearch& nearest, std::size_t point, float reach,
                std::vector<std::uint32_t>& found) {
    constexpr std::size_t kMostFound = 4096;
    found.resize(kMostFound);
    found.resize(std::min(nearest.within(points.positions[point], reach * reach, found), kMostFound));
}

/// Whether a point is at a gap: its neighbours are on one side, but points at up to four times their distance are in a
/// plane and on all sides.
bool isAtGap(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest, std::size_t point,
             std::vector<std::uint32_t>& found) {
    constexpr float kFarther = 4;
    if (!isOneSided(lists, points, point)) return false;
    const float radius = lists.radius(points, point);
    findWithin(points, nearest, point, kFarther * radius, found);
    const PlaneFit plane = fitPlane(momentsOf(points, found, point));
    if (!(plane.misfit < kFlatAroundLine)) return false;
    const Vec3f u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    std::vector<float> angles;
    for (const std::uint32_t other : found) {
        const Vec3f offset = points.positions[other] - points.positions[point];
        if (offset.squaredNorm() > radius * radius) angles.push_back(std::atan2(v.dot(offset), u.dot(offset)));
    }
    std::sort(angles.begin(), angles.end());
    return gapsBetween(angles).widest < kWidestGap;
}

/// Whether the neighbours of a point are scattered, while all points within several times their distance are in a
/// plane.
bool isBlurred(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest, std::size_t point,
               std::vector<std::uint32_t>& found) {
    // Nine in ten points of a solid ball are above kBlurred. Noise of 2 spacings has a misfit of 0.02 within 8 radii,
    // noise of 4 spacings of 0.09, and there are 1,400 and 2,300 points.
    constexpr float kBlurred = 0.25f, kFlat = 0.12f, kWider = 8;
    if (!isInNoPlane(lists, points, point, kBlurred)) return false;
    findWithin(points, nearest, point, kWider * lists.radius(points, point), found);
    return misfitOf(momentsOf(points, found, point)) < kFlat;
}

/// One point's share of the counts. Probing takes longer than all else, so only some of the sampled points are probed.
void countPoint(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest, std::size_t point,
                bool probes, SurroundCounts& counts) {
    ++counts.sampled;
    counts.unsurrounded += suspicionOf(lists, points, point) >= Suspicion::kOnLine;
    counts.reaches.push_back(std::ldexp(lists.radius(points, point), points.scale_exponent));
    if (!probes) return;
    std::vector<std::uint32_t> found;
    ++counts.probed;
    counts.isolated += isIsolated(lists, points, nearest, point, found) ? kProbeStep : 0;
    counts.noisy += isBlurred(lists, points, nearest, point, found);
    counts.at_gaps += isAtGap(lists, points, nearest, point, found);
}

} // namespace

void addCounts(SurroundCounts& counts, const SurroundCounts& more) {
    counts.sampled += more.sampled;
    counts.unsurrounded += more.unsurrounded;
    counts.isolated += more.isolated;
    counts.probed += more.probed;
    counts.noisy += more.noisy;
    counts.at_gaps += more.at_gaps;
    counts.reaches.insert(counts.reaches.end(), more.reaches.begin(), more.reaches.end());
}

void countUnsurrounded(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest,
                       const std::vector<std::uint8_t>& inner, SurroundCounts& counts) {
    if (lists.k < kFewestToSurround) return;
    const std::size_t step = points.size() < kManyPoints ? 1 : kSampleStep;
    tbb::enumerable_thread_specific<SurroundCounts> counts_of_threads;
    tbb::parallel_for(std::size_t(0), (points.size() + step - 1) / step, [&](std::size_t sample) {
        if (const std::size_t point = sample * step; inner[point] != 0)
            countPoint(lists, points, nearest, point, sample % kProbeStep == 0, counts_of_threads.local());
    });
    for (const SurroundCounts& counted : counts_of_threads) addCounts(counts, counted);
}

Thinning thinningOf(SurroundCounts counts) {
    if (counts.sampled == 0) return {};
    // In random samples of a surface, 1 list in 80 is on a line, where thinning takes time and gains nothing.
    constexpr double kFewLists = 1.0 / 45, kFewIsolated = 1.0 / 50, kAllButFew = 0.02;
    // In raw range scans, noise of half a spacing blurs up to a quarter of the lists, and up to a fifteenth are at
    // gaps. In merged frames of depth cameras and of moving lidars 58 to 77% are blurred, or many are on lines.
    constexpr double kNoisyShare = 1.0 / 2, kGapShare = 1.0 / 20;
    const auto sampled = double(counts.sampled);
    const bool has_some =
        double(counts.unsurrounded) > kFewLists * sampled || double(counts.isolated) > kFewIsolated * sampled;
    const bool is_noisy = double(counts.noisy) > kNoisyShare * double(counts.probed);
    const bool has_gaps = (has_some || is_noisy) && double(counts.at_gaps) > kGapShare * double(counts.probed);
    return {quantileOf(std::move(counts.reaches), kAllButFew), has_some || is_noisy || has_gaps, is_noisy, has_gaps};
}

void surroundNeighborhoods(NeighborLists& lists, const PointSet& points, const NearestSearch& nearest,
                           const Thinning& thinning, const StageShare& share) {
    if (lists.k < kFewestToSurround || !(thinning.finest_cells > 0)) return share.report(1);
    std::vector<Suspicion> suspicions(points.size());
    const double middle = (share.from + share.to) / 2;
    forEach(points.size(), {share.progress, share.stage, share.from, middle}, [&](std::size_t i) {
        suspicions[i] = thinning.is_noisy && isInNoPlane(lists, points, i, kInNoPlane) ? Suspicion::kInNoise
                                                                                       : suspicionOf(lists, points, i);
        if (thinning.has_gaps && suspicions[i] == Suspicion::kUnsuspected && isOneSided(lists, points, i))
            suspicions[i] = Suspicion::kOnOneSide;
    });
    const ThinnedCloud thinned(points, thinning.finest_cells);
    const std::vector<std::uint32_t> isolated = thinned.findIsolated();
    std::vector<std::uint32_t> hopeless(points.size());
    // Allocated once: small arrays that are freed between long-lived ones would fragment memory.
    tbb::enumerable_thread_specific<std::vector<std::optional<NearestCache>>> caches(thinned.levelCount());
    const auto replaceLists = [&](std::span<const std::uint8_t> found_before, const StageShare& part) {
        forRanges(points.size(), part, [&](std::size_t begin, std::size_t end) {
            SurroundSearch search{lists,      points,       nearest,  thinned,       isolated,
                                  suspicions, found_before, hopeless, caches.local()};
            for (std::size_t i = begin; i < end; ++i) {
                if (!found_before.empty() && found_before[i]) continue;
                if (const auto around = search.surround(i)) adopt(lists, points, i, *around);
            }
        });
    };
    replaceLists({}, {share.progress, share.stage, middle, share.to});
    const std::vector<std::uint8_t> found_first = lists.thinned;
    const auto kept = std::count(found_first.begin(), found_first.end(), 0);
    if (double(points.size()) - double(kept) > kShareToCount * double(points.size()))
        replaceLists(found_first, {share.progress, share.stage, share.to, share.to});
    limitSpacings(lists, points);
}

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/parallel_for.h>
#include <utility>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/plane_fit.h"
#include "preprocess/surface/thinned_cloud.h"

namespace pointrt::surface {
namespace {

/// Distance to the k-th neighbour of an outlier, divided by that of its neighbours. A point nine spacings off a surface
/// reaches this ratio.
constexpr float kFarTimes = 4;

/// Islands of a surface seen through a gap are as large as the gap, to within a factor of 5 in raw range scans; clumps
/// of outliers there are 45 times their size away from other points.
constexpr float kClumpDistance = 20;

/// Quantile of distances to the k-th neighbour: outliers are too few to change it.
constexpr double kCommonShare = 0.95;

/// Least misfit of a plane to a floater's neighbours (smallest over middle eigenvalue). With this and the other rules,
/// 9 in 10 floaters spread evenly around a sphere go. A round surface stays below it however sparse it is: 0.03 for a
/// cap of half a radian.
constexpr float kNoPlane = 0.15f;

/// At more than twice the distance, the neighbours may be the near side of the whole scan, which looks flatter from
/// there. One in ten thousand caps of 17 random points and 0.4 radians is above.
constexpr float kFarOut = 2, kNoPlaneFarOut = 0.1f;

/// For points near a surface, below kFarTimes: the height over the neighbours' plane and the distance to the k-th
/// neighbour, each divided by that of the neighbours. 1 in 80,000 points of a photogrammetric surface exceeds both
/// limits, and so do three in four outliers within nine spacings of it.
constexpr float kBesideHeight = 4, kBesideReach = 1.7f;

struct OutlierJob {
    const PointSet& points;
    const NeighborLists& lists;
    std::vector<float> distances; ///< [points], to the k-th neighbour
    float floater_distance = 0;
};

/// Whether the point is one of many floating in space, far apart: they are each other's neighbours, so none is
/// conspicuous.
bool isFloater(const OutlierJob& job, std::size_t point) {
    if (job.distances[point] <= job.floater_distance) return false;
    const float misfit = misfitOf(momentsOf(job.points, job.lists.of(point), point));
    const float flat = job.distances[point] > kFarOut * job.floater_distance ? kNoPlaneFarOut : kNoPlane;
    return misfit > flat && std::isfinite(misfit); // infinite: on a line, such as a sparse scan line
}

/// Whether, for three in four neighbours, a distance is `times` the distance to the neighbour's own k-th neighbour. A
/// median would fail at a jump of density, where most neighbours of a point on the sparse side may be on the dense one.
bool isFar(const OutlierJob& job, float distance, std::span<const std::uint32_t> neighbors, float times = kFarTimes) {
    const auto closer = std::count_if(neighbors.begin(), neighbors.end(), [&](std::uint32_t neighbor) {
        return distance > times * job.distances[neighbor];
    });
    return std::size_t(closer) > neighbors.size() * 3 / 4;
}

/// Whether the point is beside the surface that its neighbours are on.
bool isBeside(const OutlierJob& job, std::size_t point) {
    if (!isFar(job, job.distances[point], job.lists.of(point), kBesideReach)) return false;
    const auto k = float(job.lists.k);
    Moments moments = momentsOf(job.points, job.lists.of(point), point); // of k + 1 points, with this one at 0
    const Vec3f mean = moments.mean * ((k + 1) / k);                     // of the k others
    std::size_t at = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = row; column < 3; ++column, ++at)
            moments.covariance[at] = (moments.covariance[at] + moments.mean[row] * moments.mean[column]) * (k + 1) / k -
                                     mean[row] * mean[column];
    const PlaneFit plane = fitPlane(moments);
    if (!std::isfinite(plane.misfit)) return false;
    float squared_heights = 0;
    for (const std::uint32_t neighbor : job.lists.of(point)) {
        const float height = plane.normal.dot(job.points.positions[neighbor] - job.points.positions[point] - mean);
        squared_heights += height * height;
    }
    const float height = plane.normal.dot(mean);
    return height * height * k > kBesideHeight * kBesideHeight * squared_heights;
}

/// Whether the point and its first `others` neighbours are a clump far from the remaining neighbours.
bool isClump(const OutlierJob& job, std::size_t point, std::size_t others) {
    const float gap = job.lists.distance(job.points, point, others);
    if (gap < kClumpDistance * job.lists.distance(job.points, point, others - 1)) return false;
    return isFar(job, gap, job.lists.of(point).subspan(others));
}

bool isOutlier(const OutlierJob& job, std::size_t point) {
    if (isFar(job, job.distances[point], job.lists.of(point))) return true;
    if (isFloater(job, point) || isBeside(job, point)) return true;
    for (std::size_t others = 1; others < job.lists.k; ++others)
        if (isClump(job, point, others)) return true;
    return false;
}

/// Representatives to examine around a point that may lie between them. Their cells are half as wide as the distance to
/// the k-th neighbour: wider ones would reach beyond the halos of tiles.
constexpr std::size_t kAround = 24;
/// Edge of the finest cells, divided by the distance of floaters: an eighth of the 95th percentile of distances to the
/// k-th neighbour. Sparse samples need a larger edge; tiles measure the same percentile as the whole cloud.
constexpr float kFinestShare = 1.0f / 32;
/// Fewest representatives on one side of a sparse sample of a surface, even at a straight border, where about half of
/// them are left.
constexpr std::size_t kFewOnASide = 3;
/// Largest height over the plane of the representatives, over their own standard deviation.
constexpr float kAmongHeights = 2;

/// Whether a point lies on the plane of points, and between them: in at least three of four quadrants of the plane.
bool liesAmong(const PointSet& points, std::span<const std::uint32_t> around, std::size_t point) {
    const Moments moments = momentsOf(points, around, point);
    const PlaneFit plane = fitPlane(moments);
    if (!(plane.misfit < kNoPlane)) return false;
    const Vec3f u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    float squared_heights = 0;
    std::array<std::size_t, 4> in_quadrant{};
    for (const std::uint32_t other : around) {
        const Vec3f offset = points.positions[other] - points.positions[point];
        const float height = plane.normal.dot(offset - moments.mean);
        squared_heights += height * height;
        ++in_quadrant[std::size_t(u.dot(offset) > 0) + 2 * std::size_t(v.dot(offset) > 0)];
    }
    const float height = plane.normal.dot(moments.mean);
    if (height * height * float(around.size()) > kAmongHeights * kAmongHeights * squared_heights) return false;
    return std::count_if(in_quadrant.begin(), in_quadrant.end(),
                         [](std::size_t count) { return count >= kFewOnASide; }) >= 3;
}

/// Whether a point that is far from its neighbours is a sample of a sparse part of a surface, beside a dense part or a
/// clump that most of its neighbours are in: in thinned clouds, those count less.
bool isOnSparseSurface(const OutlierJob& job, const ThinnedCloud& thinned, std::size_t point) {
    std::array<std::uint32_t, kAround + 1> found;
    std::array<float, kAround + 1> squared;
    const std::size_t number = thinned.levelFor(job.distances[point] / 2);
    if (number == thinned.levelCount()) return false;
    const ThinnedLevel& level = thinned.level(number);
    const std::size_t count = level.search.nearest(job.points.positions[point], found, squared);
    std::vector<std::uint32_t> around;
    for (std::size_t i = 0; i < count; ++i)
        if (level.points[found[i]] != point) around.push_back(level.points[found[i]]);
    return around.size() >= kAround && liesAmong(job.points, around, point);
}

/// Spares samples of sparse parts among the outliers.
void spareSparseSurfaces(const OutlierJob& job, std::vector<std::uint8_t>& keep) {
    std::vector<std::uint32_t> outliers;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (!keep[i] && !isFloater(job, i)) outliers.push_back(std::uint32_t(i));
    if (outliers.empty()) return;
    const ThinnedCloud thinned(job.points, kFinestShare * job.floater_distance);
    tbb::parallel_for(std::size_t(0), outliers.size(),
                      [&](std::size_t i) { keep[outliers[i]] = isOnSparseSurface(job, thinned, outliers[i]); });
}

} // namespace

std::vector<std::uint8_t> flagInliers(const PointSet& points, const NeighborLists& lists,
                                      std::optional<float> common_reach) {
    std::vector<std::uint8_t> keep(points.size(), 1);
    if (!common_reach && points.size() < kMinPointsForOutliers) return keep;
    OutlierJob job{points, lists, std::vector<float>(points.size())};
    tbb::parallel_for(std::size_t(0), points.size(),
                      [&](std::size_t i) { job.distances[i] = lists.radius(points, i); });
    job.floater_distance = kFarTimes * (common_reach ? *common_reach : commonReach(job.distances));
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) { keep[i] = !isOutlier(job, i); });
    spareSparseSurfaces(job, keep);
    // If most points seem to be outliers, the sampling is sparse: only floaters of a larger cloud are removed.
    if (std::size_t(std::count(keep.begin(), keep.end(), 1)) < points.size() / 2)
        for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !(common_reach && isFloater(job, i));
    return keep;
}

float commonReach(std::vector<float> distances) { return quantileOf(std::move(distances), kCommonShare); }

} // namespace pointrt::surface

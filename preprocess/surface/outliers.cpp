// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/outliers.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <utility>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// How many times further than its neighbours a stray reaches. Nine spacings away from a surface it gets there.
constexpr float kStrayReach = 4;

/// Islands of a surface seen through a gap are as large as the gap, to within a factor of 5 in raw range scans;
/// clumps of strays there are 45 times their size away from the rest.
constexpr float kClumpDistance = 20;

/// Floaters reach kStrayReach times as far as this share of all points, which strays are too few to change.
constexpr double kCommonShare = 0.95;

/// And they lie in no plane: a neighbourhood's smallest eigenvalue is above this share of the middle one. Of floaters
/// spread evenly round a sphere 9 in 10 go by this and the other rules. A round surface stays below however sparse it
/// is: a cap of half a radian has 0.03.
constexpr float kNoPlane = 0.15f;

/// Twice as far out, a floater's neighbours may be the near side of all that was scanned, which looks flatter from
/// there. Of caps of 17 random points and 0.4 radians one in ten thousand is above.
constexpr float kFarOut = 2, kNoPlaneFarOut = 0.1f;

/// A point beside a surface reaches less than kStrayReach. It stands this many times as high over the plane of its
/// neighbours as those do, and reaches further than they by this factor: of points on a surface that was made from
/// photographs 1 in 80,000 do both, of strays nearer than nine spacings to it three in four.
constexpr float kBesideHeight = 4, kBesideReach = 1.7f;

struct StrayJob {
    const Points& points;
    const NeighborLists& lists;
    std::vector<float> reaches; ///< [points], to the k-th neighbour
    float floater_reach = 0;
};

/// Whether the point is one of many that float in space, far apart: each other's neighbours, so that none stands out.
bool isFloater(const StrayJob& job, std::size_t point) {
    if (job.reaches[point] <= job.floater_reach) return false;
    const float misfit = fitPlane(momentsOf(job.points, job.lists.of(point), point)).misfit;
    const float flat = job.reaches[point] > kFarOut * job.floater_reach ? kNoPlaneFarOut : kNoPlane;
    return misfit > flat && std::isfinite(misfit); // infinite: a line, as sparse scan lines are
}

/// Whether a distance is `times` the one within which three of four neighbours reach their k-th. Not the median: where
/// density jumps, most neighbours of a point on the sparse side may be on the dense one.
bool isFar(const StrayJob& job, float distance, std::span<const std::uint32_t> neighbors, float times = kStrayReach) {
    const auto closer = std::count_if(neighbors.begin(), neighbors.end(),
                                      [&](std::uint32_t neighbor) { return distance > times * job.reaches[neighbor]; });
    return std::size_t(closer) > neighbors.size() * 3 / 4;
}

/// Whether the point stands beside the surface that its neighbours are on.
bool isBeside(const StrayJob& job, std::size_t point) {
    if (!isFar(job, job.reaches[point], job.lists.of(point), kBesideReach)) return false;
    const auto k = float(job.lists.k);
    Moments moments = momentsOf(job.points, job.lists.of(point), point); // of k + 1 points, this one at 0
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
bool isClump(const StrayJob& job, std::size_t point, std::size_t others) {
    const float gap = job.lists.distance(job.points, point, others);
    if (gap < kClumpDistance * job.lists.distance(job.points, point, others - 1)) return false;
    return isFar(job, gap, job.lists.of(point).subspan(others));
}

bool isStray(const StrayJob& job, std::size_t point) {
    if (isFar(job, job.reaches[point], job.lists.of(point))) return true;
    if (isFloater(job, point) || isBeside(job, point)) return true;
    for (std::size_t others = 1; others < job.lists.k; ++others)
        if (isClump(job, point, others)) return true;
    return false;
}

} // namespace

std::vector<std::uint8_t> flagKept(const Points& points, const NeighborLists& lists,
                                   std::optional<float> common_reach) {
    std::vector<std::uint8_t> keep(points.size(), 1);
    if (!common_reach && points.size() < kFewForStrays) return keep;
    StrayJob job{points, lists, std::vector<float>(points.size())};
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) { job.reaches[i] = lists.reach(points, i); });
    job.floater_reach = kStrayReach * (common_reach ? *common_reach : commonReach(job.reaches));
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) { keep[i] = !isStray(job, i); });
    // A cloud of nothing but strays is no cloud with strays in it; what floats in a larger one does in its part.
    if (std::size_t(std::count(keep.begin(), keep.end(), 1)) < points.size() / 2)
        for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !(common_reach && isFloater(job, i));
    return keep;
}

float commonReach(std::vector<float> reaches) { return quantileOf(std::move(reaches), kCommonShare); }

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/planarity.h"
#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// In clouds of fewer points, neighbourhoods may be as wide as parts of an object, and planarity weights cannot
/// distinguish thin parts from scattered points. So either all of their points become balls, or none.
constexpr std::size_t kMostSparsePoints = 5000;

/// A neighbourhood is no surface if the smallest eigenvalue of its covariance over the middle one is above this: nine
/// in ten of a solid ball are (planarity.cpp). With 2,048 random samples, such neighbourhoods are 93 % of a slab a
/// tenth of an edge thick, 52 % of Lucy, 37 % of the Dragon, 17 % of the Bunny, 10 % of a cube, and 0 of a sphere or a
/// torus; with 400 samples of the Bunny 20 %, with 300 of a torus three times as wide as its tube 30 %.
constexpr float kNoSurface = 0.25f;
constexpr double kMostlySparse = 0.5;

/// A point is on no surface if its planarity weight (weighPlanarity) is below this.
constexpr float kOnSurface = 0.5f;

/// A cloud with a larger share of scattered points than this is a volume. In random points the share is 0.98; at the
/// borders of a volume points look flatter, so that in parts of 2,000 points (StatisticsSampler) it is 0.89. In scans
/// of trees it is 0.1 to 0.3, as stems and the ground are surfaces.
constexpr double kVolumeShare = 0.75;

/// A touching ball's radius over the distance to a typical neighbour.
constexpr float kTouching = 0.5f;
/// Number of neighbours whose median distance is used: a single one may be a second return from the same spot.
constexpr std::size_t kTypicalNeighbors = 3;
/// Largest radius over the cloud's median.
constexpr float kLargestBall = 3;
/// Limit below which distances underflow (radii.cpp).
constexpr float kMinBallRadius = 0x1p-24f;

/// A ball's radius over that of a disc that rays of all directions hit as often: seen from everywhere, a disc shows
/// half its area on average. The radii of discs of scattered points were measured to let through as many rays as crowns
/// do (kScattered in radii.cpp); touching balls would let through far fewer.
constexpr float kSameArea = 0.70710678f;

float touchingRadius(const PointGraph& graph, std::size_t point) {
    std::array<float, kTypicalNeighbors> distances;
    const std::size_t count = std::min(kTypicalNeighbors, graph.lists.k);
    for (std::size_t i = 0; i < count; ++i) distances[i] = graph.lists.distance(graph.points, point, i);
    const auto end = distances.begin() + std::ptrdiff_t(count);
    std::sort(distances.begin(), end);
    return std::max(kTouching * distances[count / 2], kMinBallRadius);
}

/// Among random points, the distances to the nearest neighbours are so uneven that one radius in ten is over 3.6 times
/// another.
float typicalRadius(const std::vector<float>& touching, std::span<const std::uint32_t> neighbors, std::size_t point) {
    std::vector<float> around{touching[point]};
    for (const std::uint32_t neighbor : neighbors) around.push_back(touching[neighbor]);
    return medianInPlace(around);
}

} // namespace

bool isTooSparse(const PointGraph& graph) {
    const std::size_t count = graph.points.size();
    if (count >= kMostSparsePoints) return false;
    std::size_t volumetric = 0;
    for (std::size_t i = 0; i < count; ++i)
        volumetric += misfitOf(momentsOf(graph.points, graph.lists.of(i), i)) > kNoSurface;
    return double(volumetric) > kMostlySparse * double(count);
}

bool isVolume(std::size_t scattered, std::size_t points) {
    return scattered > 0 && double(scattered) >= kVolumeShare * double(points);
}

void setBallRadii(PointGraph& graph, const StageShare& share) {
    PointSet& points = graph.points;
    points.radii.resize(points.size());
    std::vector<float> touching(points.size());
    const double middle = (share.from + share.to) / 2;
    const StageShare first{share.progress, share.stage, share.from, middle};
    const StageShare second{share.progress, share.stage, middle, share.to};
    forEach(points.size(), first, [&](std::size_t i) { touching[i] = touchingRadius(graph, i); });
    forEach(points.size(), second,
            [&](std::size_t i) { points.radii[i] = typicalRadius(touching, graph.lists.of(i), i); });
    const float limit = kLargestBall * medianOf(points.radii);
    for (std::size_t i = 0; i < points.size(); ++i)
        points.radii[i] = points.hasGivenRadius(i) ? points.given_radii[i] : std::min(points.radii[i], limit);
}

bool mayHaveBalls(const PointSet& points, std::optional<bool> decided) {
    if (decided || points.planarity.empty()) return decided.value_or(false);
    if (points.size() < kMostSparsePoints) return false;
    const std::vector<std::uint8_t> balls = flagBalls(points);
    return isScattered(std::size_t(std::count(balls.begin(), balls.end(), 1)), balls.size());
}

std::vector<std::uint8_t> flagBalls(const PointSet& points) {
    std::vector<std::uint8_t> balls(points.planarity.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        balls[i] = points.planarity[i] < kOnSurface && !points.hasGivenRadius(i);
    return balls;
}

void shrinkBalls(PointSet& points, const std::vector<std::uint8_t>& balls) {
    for (std::size_t i = 0; i < balls.size(); ++i)
        if (balls[i]) points.radii[i] *= kSameArea;
}

} // namespace pointrt::surface

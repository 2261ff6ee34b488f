// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "format/base/error.h"
#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

constexpr const char* kNormals = "normals";

std::vector<std::uint8_t> flagGiven(const PointSet& points, NormalSource source) {
    std::vector<std::uint8_t> given(points.size(), 0);
    if (source == NormalSource::kEstimate || points.normals.empty()) return given;
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = !points.normals[i].isZero(0);
    return given;
}

void requireAll(const std::vector<std::uint8_t>& given) {
    const auto missing = std::count(given.begin(), given.end(), 0);
    if (missing == 0) return;
    throw Error{ExitCode::kBadInput, std::to_string(missing) + " of " + std::to_string(given.size()) +
                                         " points have no normal to keep; --normals auto estimates them"};
}

/// Plane fits at growing scales; each point keeps the normal of the scale that fits best.
struct ScaleSpace {
    std::vector<Moments> moments;
    std::vector<float> misfit;
};

/// Takes fits at the current scale if they are better than the points' own. Each doubling of the neighbourhood's area
/// halves the misfit that noise causes, doubles the one from curvature, and raises it more at edges. Among equals the
/// smaller scale wins: kBetter and the two widenings gave the least error over raw range scans, and noisy and clean
/// samples of meshes.
void takeBetterFits(ScaleSpace& scales, PointSet& points, const std::vector<std::uint8_t>& given,
                    const StageShare& share) {
    constexpr float kBetter = 0.9f;
    forEach(points.size(), share, [&](std::size_t i) {
        if (given[i]) return;
        const PlaneFit fit = fitPlane(scales.moments[i]);
        if (!(fit.misfit < kBetter * scales.misfit[i])) return;
        scales.misfit[i] = fit.misfit;
        points.normals[i] = fit.normal;
    });
}

void startScales(ScaleSpace& scales, PointSet& points, const NeighborLists& lists,
                 const std::vector<std::uint8_t>& given, const StageShare& share) {
    scales.moments.resize(points.size());
    scales.misfit.resize(points.size());
    forEach(points.size(), share, [&](std::size_t i) {
        scales.moments[i] = momentsOf(points, lists.of(i), i);
        if (given[i]) return;
        const PlaneFit fit = fitPlane(scales.moments[i]);
        scales.misfit[i] = fit.misfit;
        points.normals[i] = fit.normal;
    });
}

void widen(ScaleSpace& scales, const PointSet& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<Moments> wider(points.size());
    forEach(points.size(), share, [&](std::size_t i) { wider[i] = spreadMoments(scales.moments, points, lists, i); });
    scales.moments.swap(wider);
}

/// Bilateral filter: the average of a normal and its neighbours', weighted by distance and by agreement, so that edges
/// stay sharp. Normals may be on either side.
Vec3f smoothNormal(const PointSet& points, const NeighborLists& lists, std::size_t point) {
    constexpr float kUnrelated = 0.8f; // cosine of 37 degrees: neighbours further off do not count
    const Vec3f normal = points.normals[point];
    // The farthest neighbour has weight exp(-1.5^2) = 0.1. If squared distances underflow, all weigh the same.
    const float width = std::max(lists.radius(points, point) / 1.5f, std::numeric_limits<float>::min());
    const auto neighbors = lists.of(point);
    Vec3f sum = normal;
    for (std::size_t i = 0; i < neighbors.size(); ++i) {
        const Vec3f& other = points.normals[neighbors[i]];
        const float cosine = normal.dot(other), agreement = (std::abs(cosine) - kUnrelated) / (1 - kUnrelated);
        if (!(agreement > 0)) continue;
        const float steps = lists.distance(points, point, i) / width;
        sum += std::copysign(agreement * std::exp(-steps * steps), cosine) * other;
    }
    return sum.normalized();
}

void smoothNormals(PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& given,
                   const StageShare& share) {
    std::vector<Vec3f> smooth(points.normals);
    forEach(points.size(), share, [&](std::size_t i) {
        if (!given[i]) smooth[i] = smoothNormal(points, lists, i);
    });
    points.normals.swap(smooth);
}

/// Plane fits over the neighbours, and over neighbourhoods 2 and 4 times their area if those fit better: where scans
/// overlap with an error near their spacing, as in merged range images. The wider ones come from averaging moments over
/// neighbours. Each time that adds one neighbourhood's variance (as in heat diffusion over the graph), and it never
/// reaches a sheet that no neighbour is on.
void estimateNormals(PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& given,
                     const StageProgress& progress) {
    constexpr int kWidenings[] = {1, 2};
    constexpr double kSteps = 1 + 3 + 2 + 1; // first fits, 3 widenings, 2 more fits, smoothing
    ScaleSpace scales;
    double done = 1 / kSteps;
    const auto next = [&] { return StageShare{progress, kNormals, done, done += 1 / kSteps}; };
    startScales(scales, points, lists, given, {progress, kNormals, 0, done});
    for (const int widenings : kWidenings) {
        for (int i = 0; i < widenings; ++i) widen(scales, points, lists, next());
        takeBetterFits(scales, points, given, next());
    }
    scales = {};
    smoothNormals(points, lists, given, next());
}

} // namespace

void fillNormals(PointGraph& graph, NormalSource source, const StageProgress& progress) {
    PointSet& points = graph.points;
    points.side_known = flagGiven(points, source);
    const std::vector<std::uint8_t>& given = points.side_known;
    if (source == NormalSource::kKeep) requireAll(given);
    if (std::count(given.begin(), given.end(), 0) == 0) return;
    points.normals.resize(points.size(), Vec3f::Zero());
    estimateNormals(points, graph.lists, given, progress);
}

} // namespace pointrt::surface

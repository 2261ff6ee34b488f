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

constexpr const char* kStage = "normals";

std::vector<std::uint8_t> flagGiven(const Points& points, NormalSource source) {
    std::vector<std::uint8_t> given(points.size(), 0);
    if (source == NormalSource::kEstimate || points.normals.empty()) return given;
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = !points.normals[i].isZero(0);
    return given;
}

void requireAll(const std::vector<std::uint8_t>& given) {
    const auto missing = std::count(given.begin(), given.end(), 0);
    if (missing == 0) return;
    throw Error{ExitCode::kBadInput, std::to_string(missing) + " of " + std::to_string(given.size()) +
                                         " points have no normal to keep: let them be estimated"};
}

/// Plane fits at growing scales; each point keeps the normal of the scale that suits it best.
struct ScaleSpace {
    std::vector<Moments> moments;
    std::vector<float> misfit;
};

/// Takes the fit when it is better than what the point has. Noise of a fixed height makes the misfit fall by half with
/// each doubling of the neighbourhood's area; curvature makes it double, and an edge jump. Of equals the smaller wins:
/// kBetter and the two widenings gave the least error over raw range scans, noisy and clean samples of meshes.
void offerFits(ScaleSpace& scales, Points& points, const std::vector<std::uint8_t>& given, const StageShare& share) {
    constexpr float kBetter = 0.9f;
    forEach(points.size(), share, [&](std::size_t i) {
        if (given[i]) return;
        const PlaneFit fit = fitPlane(scales.moments[i]);
        if (!(fit.misfit < kBetter * scales.misfit[i])) return;
        scales.misfit[i] = fit.misfit;
        points.normals[i] = fit.normal;
    });
}

void startScales(ScaleSpace& scales, Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& given,
                 const StageShare& share) {
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

void widen(ScaleSpace& scales, const Points& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<Moments> wider(points.size());
    forEach(points.size(), share, [&](std::size_t i) { wider[i] = spreadMoments(scales.moments, points, lists, i); });
    scales.moments.swap(wider);
}

/// The average of a normal with its neighbours', weighted by nearness and by agreement, so that nothing is averaged
/// across an edge (a bilateral filter). Normals may be on either side.
Vec3f smoothNormal(const Points& points, const NeighborLists& lists, std::size_t point) {
    constexpr float kUnrelated = 0.8f; // cosine of 37 degrees: from here on a neighbour has no say
    const Vec3f normal = points.normals[point];
    // The farthest neighbour weighs exp(-1.5^2) = 0.1. Where the squares of distances vanish all weigh the same.
    const float width = std::max(lists.reach(points, point) / 1.5f, std::numeric_limits<float>::min());
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

void smoothNormals(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& given,
                   const StageShare& share) {
    std::vector<Vec3f> smooth(points.normals);
    forEach(points.size(), share, [&](std::size_t i) {
        if (!given[i]) smooth[i] = smoothNormal(points, lists, i);
    });
    points.normals.swap(smooth);
}

/// Plane fits over the neighbours, and over neighbourhoods 2 and 4 times their area where those fit better:
/// where scans overlap with an error near their spacing, as in merged range images.
/// The wider ones come from averaging moments over neighbours, which adds one neighbourhood's variance each time
/// (as heat spreads over the graph) and never jumps to another sheet that no neighbour is on.
void estimateNormals(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& given,
                     const StageProgress& progress) {
    constexpr int kWidenings[] = {1, 2};
    constexpr double kSteps = 1 + 3 + 2 + 1; // a start, 3 widenings, 2 fits, a smoothing
    ScaleSpace scales;
    double done = 1 / kSteps;
    const auto next = [&] { return StageShare{progress, kStage, done, done += 1 / kSteps}; };
    startScales(scales, points, lists, given, {progress, kStage, 0, done});
    for (const int widenings : kWidenings) {
        for (int i = 0; i < widenings; ++i) widen(scales, points, lists, next());
        offerFits(scales, points, given, next());
    }
    scales = {};
    smoothNormals(points, lists, given, next());
}

} // namespace

std::vector<std::uint8_t> fillNormals(Points& points, const NeighborLists& lists, NormalSource source,
                                      const StageProgress& progress) {
    std::vector<std::uint8_t> given = flagGiven(points, source);
    if (source == NormalSource::kKeep) requireAll(given);
    if (std::count(given.begin(), given.end(), 0) > 0) {
        points.normals.resize(points.size(), Vec3f::Zero());
        estimateNormals(points, lists, given, progress);
    }
    return given;
}

} // namespace pointrt::surface

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pointrt/measure.hpp"
#include "runtime/studies/cast_batch.h"
#include "runtime/studies/point_rows.h"
#include "runtime/studies/study_values.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

/// Rays start this many radii behind a point, because positions in cells are rounded to a hundredth of the radius.
constexpr double kStartBehind = 0.02;

struct NormalRay {
    std::size_t row;
    double behind; ///< distance from the ray's start to the point
};

bool hasNormal(const StudyPoints& points, std::size_t row) {
    const float* n = points.normals.data() + 3 * row;
    const double size = length({double{n[0]}, double{n[1]}, double{n[2]}});
    return std::isfinite(size) && size > 0;
}

/// The signed distance from the nearer of two hits. If that is the hit along the normal, the point is behind the
/// surface, so the distance is negative.
double signedDistance(double along, double against) { return along < against ? -along : against; }

/// Both rays of the points in [first, last) that have a normal.
std::vector<NormalRay> addRays(const StudyPoints& points, std::size_t first, std::size_t last, CastBatch& batch) {
    std::vector<NormalRay> rays;
    for (std::size_t row = first; row < last; ++row) {
        if (!hasNormal(points, row)) continue;
        const StudyDisc disc = discAt(points, row, {});
        const double behind = kStartBehind * disc.radius;
        batch.add(disc.center - behind * disc.normal, disc.normal);
        batch.add(disc.center + behind * disc.normal, -1.0 * disc.normal);
        rays.push_back({row, behind});
    }
    return rays;
}

} // namespace

std::uint64_t surfaceDistances(const TraceScene& scene, const StudyPoints& points, double most,
                               std::span<double> distances) {
    requireRows(points, distances.size(), {});
    if (points.normals.empty()) refuseUsage("the points have no normals to measure along");
    if (!(most > 0)) refuseUsage("the largest distance must be above 0");
    std::ranges::fill(distances, std::numeric_limits<double>::quiet_NaN());
    CastBatch batch;
    std::uint64_t cast = 0;
    constexpr std::size_t kPointsAtOnce = kRaysAtOnce / 2; // two rays each
    for (std::size_t first = 0; first < distances.size(); first += kPointsAtOnce) {
        batch.clear();
        const std::vector<NormalRay> rays =
            addRays(points, first, std::min(distances.size(), first + kPointsAtOnce), batch);
        double farthest = 0;
        for (const NormalRay& ray : rays) farthest = std::max(farthest, ray.behind);
        const std::span<const double> hits = batch.cast(scene, {0, most + farthest});
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double distance = signedDistance(hits[2 * i] - rays[i].behind, hits[2 * i + 1] - rays[i].behind);
            if (std::abs(distance) <= most) distances[rays[i].row] = distance;
        }
        cast += batch.size();
    }
    return cast;
}

DistanceStatistics distanceStatistics(std::span<double> distances) {
    const auto end = std::partition(distances.begin(), distances.end(), [](double d) { return std::isfinite(d); });
    const std::span<double> known(distances.begin(), end);
    const double none = std::numeric_limits<double>::quiet_NaN();
    DistanceStatistics result{known.size(), distances.size() - known.size(), none, none, none, none, none, none, none};
    if (known.empty()) return result;
    const auto count = static_cast<double>(known.size());
    const auto ranked = [&](double share) { // nearest rank
        const double rank = std::ceil(share * count);
        const auto at = known.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0) - 1);
        std::nth_element(known.begin(), at, known.end());
        return *at;
    };
    result.median = ranked(0.5);
    const auto [low, high] = std::ranges::minmax(known);
    result.low = low;
    result.high = high;
    double sum = 0, squares = 0;
    for (const double d : known) sum += d;
    result.mean = sum / count;
    for (const double d : known) squares += (d - result.mean) * (d - result.mean);
    result.deviation = std::sqrt(squares / count);
    result.rms = std::hypot(result.deviation, result.mean);
    for (double& d : known) d = std::abs(d);
    result.percentile_95 = ranked(0.95);
    return result;
}

} // namespace pointrt

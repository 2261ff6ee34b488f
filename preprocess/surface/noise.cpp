// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/noise.h"

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/quadric.h"

namespace pointrt::surface {
namespace {

float noiseAt(const PointSet& points, const NeighborLists& lists, std::size_t point) {
    const float measured = float(std::sqrt(residualVariance(points, lists.of(point), point)));
    return points.given_noise.empty() ? measured : std::max(measured, points.given_noise[point]);
}

/// The median residual, unless that is shape: noise is everywhere, while houses and trees that were sampled too
/// sparsely leave quiet places. Over the residual of the quietest twentieth, the median is 2.3 to 3.5 in raw range
/// scans, a gridded station and a dense airborne survey, and 12 to 23 in airborne surveys thinned to a point in 10 m.
/// @param repeated the same places were measured again and again: what differs is noise
float noiseOfScan(std::vector<float>& over_spacing, bool repeated) {
    constexpr float kOverQuiet = 4;
    constexpr double kQuietShare = 1.0 / 20;
    if (over_spacing.empty()) return 0;
    const float median = medianInPlace(over_spacing);
    return repeated ? median : std::min(median, kOverQuiet * quantileOf(over_spacing, kQuietShare));
}

} // namespace

std::vector<float> scanNoise(const PointSet& points, const NeighborLists& lists, std::size_t scan_count) {
    constexpr std::size_t kStep = 8; // enough for a median
    std::vector<float> over_spacing((points.size() + kStep - 1) / kStep);
    const StageProgress silent;
    forEach(over_spacing.size(), {silent, ""},
            [&](std::size_t i) { over_spacing[i] = noiseAt(points, lists, i * kStep) / lists.spacings[i * kStep]; });
    std::vector<std::vector<float>> by_scan(scan_count);
    std::vector<std::size_t> in_clumps(scan_count);
    for (std::size_t i = 0; i < over_spacing.size(); ++i) {
        if (points.hasGivenRadius(i * kStep)) continue;
        const std::size_t scan = points.scan_of_point.empty() ? 0 : points.scan_of_point[i * kStep];
        by_scan[scan].push_back(over_spacing[i]);
        in_clumps[scan] += (lists.thinned[i * kStep] & kClump) != 0;
    }
    std::vector<float> noise;
    for (std::size_t scan = 0; scan < scan_count; ++scan)
        noise.push_back(noiseOfScan(by_scan[scan], 2 * in_clumps[scan] > by_scan[scan].size()));
    return noise;
}

std::vector<float> localNoise(const PointSet& points, const NeighborLists& lists, const StageShare& share) {
    const double fits_end = share.from + (share.to - share.from) * 0.7; // as measured
    std::vector<float> own(points.size()), medians(points.size());
    forEach(own.size(), {share.progress, share.stage, share.from, fits_end},
            [&](std::size_t i) { own[i] = noiseAt(points, lists, i); });
    forRanges(own.size(), {share.progress, share.stage, fits_end, share.to}, [&](std::size_t begin, std::size_t end) {
        std::vector<float> around;
        for (std::size_t i = begin; i < end; ++i) {
            if (points.hasGivenRadius(i)) continue;
            around.assign(1, own[i]);
            for (const std::uint32_t neighbor : lists.of(i))
                if (!points.hasGivenRadius(neighbor)) around.push_back(own[neighbor]);
            medians[i] = medianInPlace(around);
        }
    });
    return medians;
}

} // namespace pointrt::surface

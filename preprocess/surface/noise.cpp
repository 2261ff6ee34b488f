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
/// Samples in clumps measured the same places again and again: what differs there is noise.
float noiseOfScan(NoiseSamples& samples, std::size_t scan) {
    constexpr float kOverQuiet = 4;
    constexpr double kQuietShare = 1.0 / 20;
    std::vector<float>& over_spacing = samples.over_spacing[scan];
    if (over_spacing.empty()) return 0;
    const bool repeated = 2 * samples.in_clumps[scan] > over_spacing.size();
    const float median = medianInPlace(over_spacing);
    return repeated ? median : std::min(median, kOverQuiet * quantileOf(over_spacing, kQuietShare));
}

} // namespace

std::vector<float> scanNoise(const PointSet& points, const NeighborLists& lists, std::size_t scan_count) {
    constexpr std::size_t kStep = 8; // enough for a median
    NoiseSamples samples{std::vector<std::vector<float>>(scan_count), std::vector<std::size_t>(scan_count)};
    sampleNoise(points, lists, std::vector<std::uint8_t>(points.size(), 1), kStep, samples);
    std::vector<float> noise;
    for (std::size_t scan = 0; scan < scan_count; ++scan) noise.push_back(noiseOfScan(samples, scan));
    return noise;
}

void sampleNoise(const PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& inner,
                 std::size_t step, NoiseSamples& samples) {
    std::vector<float> over_spacing((points.size() + step - 1) / step);
    const StageProgress silent;
    forEach(over_spacing.size(), {silent, ""}, [&](std::size_t i) {
        if (inner[i * step]) over_spacing[i] = noiseAt(points, lists, i * step) / lists.spacings[i * step];
    });
    for (std::size_t i = 0; i < over_spacing.size(); ++i) {
        if (points.hasGivenRadius(i * step) || !inner[i * step]) continue;
        const std::size_t scan = points.scan_of_point.empty() ? 0 : points.scan_of_point[i * step];
        samples.over_spacing[scan].push_back(over_spacing[i]);
        samples.in_clumps[scan] += (lists.thinned[i * step] & kClump) != 0;
    }
}

std::vector<float> noiseOf(NoiseSamples samples) {
    NoiseSamples all{{{}}, {0}};
    for (std::size_t scan = 0; scan < samples.over_spacing.size(); ++scan) {
        const std::vector<float>& more = samples.over_spacing[scan];
        all.over_spacing[0].insert(all.over_spacing[0].end(), more.begin(), more.end());
        all.in_clumps[0] += samples.in_clumps[scan];
    }
    const float usual = noiseOfScan(all, 0);
    std::vector<float> noise;
    for (std::size_t scan = 0; scan < samples.over_spacing.size(); ++scan)
        noise.push_back(samples.over_spacing[scan].empty() ? usual : noiseOfScan(samples, scan));
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

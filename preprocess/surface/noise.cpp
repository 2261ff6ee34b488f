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

} // namespace

std::vector<float> scanNoise(const PointSet& points, const NeighborLists& lists, std::size_t scan_count) {
    constexpr std::size_t kStep = 8; // enough for a median
    std::vector<float> over_spacing((points.size() + kStep - 1) / kStep);
    const StageProgress silent;
    forEach(over_spacing.size(), {silent, ""},
            [&](std::size_t i) { over_spacing[i] = noiseAt(points, lists, i * kStep) / lists.spacings[i * kStep]; });
    std::vector<std::vector<float>> by_scan(scan_count);
    for (std::size_t i = 0; i < over_spacing.size(); ++i)
        if (!points.hasGivenRadius(i * kStep))
            by_scan[points.scan_of_point.empty() ? 0 : points.scan_of_point[i * kStep]].push_back(over_spacing[i]);
    std::vector<float> noise;
    for (std::vector<float>& of_scan : by_scan) noise.push_back(medianInPlace(of_scan));
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

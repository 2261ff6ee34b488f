// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/dense_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

/// The smallest share of the splats to show.
constexpr double kLeastShare = 0.9;
/// The distance is chosen at which the share of the splats divided by this power of the distance is largest. In the
/// corners of a square, which hold few splats, the share grows with the 0.4th power of the distance, in corridors with
/// the first, and in frames of spinning lidars, beyond nine tenths, with at most the 0.2th.
constexpr double kPower = 0.25;

double medianAlong(const SceneSample& sample, Vec3 axis) {
    std::vector<double> values;
    for (const SampledSplat& splat : sample.splats) values.push_back(dot(splat.position, axis));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// [splats] horizontal distance from the middle
std::vector<double> distancesFromMiddle(const SceneSample& sample, Vec3 up) {
    const Vec3 front = frontSide(up), right = cross(up, front);
    const double x = medianAlong(sample, right), y = medianAlong(sample, front);
    std::vector<double> distances;
    for (const SampledSplat& splat : sample.splats)
        distances.push_back(std::hypot(dot(splat.position, right) - x, dot(splat.position, front) - y));
    return distances;
}

/// The distance at which the share of the splats over its power is largest.
double bestReach(std::vector<double> distances) {
    std::sort(distances.begin(), distances.end());
    double best = distances.back(), most = 0;
    for (auto i = static_cast<std::size_t>(kLeastShare * static_cast<double>(distances.size())); i < distances.size();
         ++i) {
        const double shown = static_cast<double>(i + 1) / std::pow(distances[i], kPower);
        if (distances[i] > 0 && shown > most) most = shown, best = distances[i];
    }
    return best;
}

} // namespace

SceneSample densePart(const SceneSample& sample, Vec3 up) {
    if (sample.splats.size() < kEachCounts) return sample;
    const std::vector<double> distances = distancesFromMiddle(sample, up);
    const double reach = bestReach(distances);
    SceneSample dense = sample;
    dense.splats.clear();
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (distances[i] <= reach) dense.splats.push_back(sample.splats[i]);
    return dense;
}

} // namespace pointrt

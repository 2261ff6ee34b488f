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
/// The chosen distance maximizes the share of the splats within it divided by this power of the distance. That share
/// grows with the distance to the power 0.4 in the corners of a square, which hold few splats, to the power 1 in
/// corridors, and to at most the power 0.2 in the outermost tenth of frames of spinning lidars.
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

/// The distance with the largest quotient of the share of splats within it and its power kPower.
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

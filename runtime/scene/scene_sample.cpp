// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/scene_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pointrt {
namespace {

/// Shares to ignore at each end: one that does not matter, and the strays of the worst scans.
constexpr double kFew = 0.001, kManyStrays = 0.025;

double quantile(std::vector<double>& values, double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

Extent extentWithout(std::vector<double>& values, double share) {
    const double low = quantile(values, share);
    return {low, quantile(values, 1 - share)};
}

double luminanceOf(const SampledSplat& splat) { // Rec. 709
    return 0.2126 * double{splat.color[0]} + 0.7152 * double{splat.color[1]} + 0.0722 * double{splat.color[2]};
}

template <typename Measure>
SampleBox boxOf(const SceneSample& sample, const Measure& extent) {
    std::vector<double> x, y, z;
    for (const SampledSplat& splat : sample.splats) {
        x.push_back(splat.position.x);
        y.push_back(splat.position.y);
        z.push_back(splat.position.z);
    }
    const Extent along_x = extent(x), along_y = extent(y), along_z = extent(z);
    return {{along_x.low, along_y.low, along_z.low}, {along_x.high, along_y.high, along_z.high}};
}

} // namespace

Extent extentOfMost(std::vector<double>& values) { return extentWithout(values, kFew); }

double halfExtentAlong(const SampledSplat& splat, Vec3 axis) {
    const double tilt = dot(splat.normal, axis);
    return splat.radius * std::sqrt(std::max(0.0, 1 - tilt * tilt));
}

double brightReflectance(const SceneSample& sample) {
    if (sample.splats.empty()) return 0.5;
    std::vector<double> values;
    for (const SampledSplat& splat : sample.splats) values.push_back(luminanceOf(splat));
    return quantile(values, 0.95);
}

double meanReflectance(const SceneSample& sample) {
    if (sample.splats.empty()) return 0.5;
    double sum = 0;
    for (const SampledSplat& splat : sample.splats) sum += luminanceOf(splat);
    return sum / static_cast<double>(sample.splats.size());
}

std::optional<double> lowestIfTilted(const SceneSample& sample, Vec3 up) {
    std::optional<double> lowest;
    if (std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}) == 1) return lowest;
    for (const SampledSplat& splat : withoutStrays(sample).splats) {
        const double low = dot(splat.position, up) - halfExtentAlong(splat, up);
        lowest = std::min(lowest.value_or(low), low);
    }
    return lowest;
}

SampleBox boundsOf(const SceneSample& sample) {
    return boxOf(sample, [](std::vector<double>& values) { return extentWithout(values, 0); });
}

SampleBox discBounds(const SceneSample& sample) {
    SampleBox box = boundsOf(sample);
    for (const SampledSplat& splat : sample.splats) {
        const Vec3 reach{halfExtentAlong(splat, {1, 0, 0}), halfExtentAlong(splat, {0, 1, 0}),
                         halfExtentAlong(splat, {0, 0, 1})};
        const Vec3 from = splat.position - reach, to = splat.position + reach;
        box.low = {std::min(box.low.x, from.x), std::min(box.low.y, from.y), std::min(box.low.z, from.z)};
        box.high = {std::max(box.high.x, to.x), std::max(box.high.y, to.y), std::max(box.high.z, to.z)};
    }
    return box;
}

SampleBox denseBox(const SceneSample& sample) {
    return boxOf(sample, [](std::vector<double>& values) { return extentWithout(values, kManyStrays); });
}

} // namespace pointrt

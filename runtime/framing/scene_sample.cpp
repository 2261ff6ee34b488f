// SPDX-License-Identifier: Apache-2.0
#include "runtime/framing/scene_sample.h"

#include <algorithm>
#include <cstddef>

namespace pointrt {
namespace {

/// Left out at each end: what any scan may have of strays, and what some have.
constexpr double kFewStrays = 0.001, kManyStrays = 0.025;
/// Of what is left with few left out; of a surface, or of points that thin out with distance, it is more.
constexpr double kStraysReach = 0.35;

double quantile(std::vector<double>& values, double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

Extent extentWithout(std::vector<double>& values, double share) {
    const double low = quantile(values, share);
    return {low, quantile(values, 1 - share)};
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

Extent extentWithoutStrays(std::vector<double>& values) {
    const Extent most = extentWithout(values, kFewStrays), dense = extentWithout(values, kManyStrays);
    return dense.size() < kStraysReach * most.size() ? dense : most;
}

double brightReflectance(const SceneSample& sample) {
    if (sample.splats.empty()) return 0.5;
    std::vector<double> values;
    for (const SampledSplat& splat : sample.splats) // Rec. 709
        values.push_back(0.2126 * double{splat.color[0]} + 0.7152 * double{splat.color[1]} +
                         0.0722 * double{splat.color[2]});
    return quantile(values, 0.95);
}

SampleBox boxWithoutStrays(const SceneSample& sample) { return boxOf(sample, extentWithoutStrays); }

SampleBox denseBox(const SceneSample& sample) {
    return boxOf(sample, [](std::vector<double>& values) { return extentWithout(values, kManyStrays); });
}

} // namespace pointrt

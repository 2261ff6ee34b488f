// SPDX-License-Identifier: GPL-3.0-or-later
// Medians, quantiles, and noise estimates from them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pointrt {

/// The median, the upper one for an even count; 0 without values. Reorders the values.
template <typename Value>
Value medianInPlace(std::vector<Value>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <typename Value>
Value medianOf(std::vector<Value> values) {
    return medianInPlace(values);
}

/// The quantile of values (not empty). @param share fraction of values below it, in [0, 1)
template <typename Value>
Value quantileOf(std::vector<Value> values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Standard deviation of noise from the absolute values of second differences, whose coefficients 1, -2, 1 scale it by
/// sqrt(6). Half of all normal deviates lie within 0.6745 standard deviations. 0 without values.
inline double deviationBySecondDifferences(std::vector<float> sizes) {
    constexpr double kFromMedian = 1 / (2.449490 * 0.6745);
    return kFromMedian * double(medianInPlace(sizes));
}

} // namespace pointrt

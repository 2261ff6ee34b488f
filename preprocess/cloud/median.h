// SPDX-License-Identifier: GPL-3.0-or-later
// Medians and other quantiles, and what they tell of noise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pointrt {

/// The upper one of two in the middle; 0 of none. Changes the order of the values.
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

/// The value that a share of all (not empty) lie below: 0 to below 1.
template <typename Value>
Value quantileOf(std::vector<Value> values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The standard deviation of values by the sizes of their second differences: 1, -2, 1 times as many deviations are
/// sqrt(6) of them, and half of all lie within 0.6745. 0 of none.
inline double deviationBySecondDifferences(std::vector<float> sizes) {
    constexpr double kFromMedian = 1 / (2.449490 * 0.6745);
    return kFromMedian * double(medianInPlace(sizes));
}

} // namespace pointrt

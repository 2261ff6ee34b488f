// SPDX-License-Identifier: Apache-2.0
// Summary of a set of errors.
#pragma once

#include <cstddef>
#include <vector>

namespace pointrt::quality {

struct Summary {
    std::size_t count = 0;
    double mean = 0, median = 0, p99 = 0, max = 0; ///< 0 if count is 0
};

/// Quantiles are values of the set: of n sorted ones, that at index floor(share (n - 1)).
Summary summarize(std::vector<float> values);

} // namespace pointrt::quality

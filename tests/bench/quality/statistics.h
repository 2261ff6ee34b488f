// SPDX-License-Identifier: Apache-2.0
// A set of errors in four numbers.
#pragma once

#include <cstddef>
#include <vector>

namespace pointrt::quality {

struct Summary {
    std::size_t count = 0;
    double mean = 0, median = 0, p99 = 0, max = 0; ///< 0 where count is 0
};

/// Quantiles are values that occur: of n sorted ones the number floor(share (n - 1)), from 0.
Summary summarize(std::vector<float> values);

} // namespace pointrt::quality

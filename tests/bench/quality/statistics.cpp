// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/statistics.h"

#include <algorithm>
#include <numeric>

namespace pointrt::quality {

Summary summarize(std::vector<float> values) {
    if (values.empty()) return {};
    const auto quantile = [&](double share) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return static_cast<double>(*at);
    };
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    return {values.size(), mean, quantile(0.5), quantile(0.99), quantile(1)};
}

} // namespace pointrt::quality

// SPDX-License-Identifier: Apache-2.0
// The distribution of an attribute's values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "pointrt/pro.h"

namespace pointrt {

struct Histogram {
    /// The count of each value, for integers with at most kMostValues different values; else empty.
    std::map<double, std::uint64_t> values;
    /// Counts in kBins equal bins from low to high, which the last bin includes.
    std::vector<std::uint64_t> bins;
    std::uint64_t not_finite = 0;

    static constexpr std::size_t kMostValues = 32; ///< classes in use, returns, scans: few enough to list
    static constexpr std::size_t kBins = 16;
};

/// The distribution of an attribute's values, over all components.
/// @param count number of splats
Histogram histogramOf(const pro_attribute& attribute, std::size_t count);

} // namespace pointrt

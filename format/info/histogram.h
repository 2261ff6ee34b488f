// SPDX-License-Identifier: Apache-2.0
// How the values of an attribute are spread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "pointrt/pro.h"

namespace pointrt {

struct Histogram {
    /// How often each value is there, where they are whole and there are at most kMostValues of them; else empty.
    std::map<double, std::uint64_t> values;
    /// How many lie in each of kBins equal parts of low to high, the upper end in the last.
    std::vector<std::uint64_t> bins;
    std::uint64_t not_finite = 0;

    static constexpr std::size_t kMostValues = 32; ///< classes in use, returns, scans: few enough to list
    static constexpr std::size_t kBins = 16;
};

/// Over all components. count: of splats
Histogram histogramOf(const pro_attribute& attribute, std::size_t count);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/info/histogram.h"

#include <algorithm>
#include <cmath>

namespace pointrt {

namespace {

/// False if there are too many different values.
bool countValues(const pro_attribute& attribute, std::size_t numbers, Histogram& histogram) {
    if (attribute.type >= PRO_TYPE_F32) return false;
    for (std::size_t i = 0; i < numbers; ++i) {
        ++histogram.values[pro_attribute_value(&attribute, i)];
        if (histogram.values.size() > Histogram::kMostValues) return false;
    }
    return true;
}

void countBins(const pro_attribute& attribute, std::size_t numbers, Histogram& histogram) {
    constexpr double kLast = Histogram::kBins - 1;
    histogram.bins.resize(Histogram::kBins);
    // halves, because the full range of doubles has an infinite width
    const double width = attribute.high / 2 - attribute.low / 2;
    for (std::size_t i = 0; i < numbers; ++i) {
        const double value = pro_attribute_value(&attribute, i);
        if (!std::isfinite(value)) {
            ++histogram.not_finite;
            continue;
        }
        const double share = width > 0 ? (value / 2 - attribute.low / 2) / width : 0;
        ++histogram.bins[static_cast<std::size_t>(std::clamp(share * Histogram::kBins, 0.0, kLast))];
    }
}

} // namespace

Histogram histogramOf(const pro_attribute& attribute, std::size_t count) {
    Histogram histogram;
    const std::size_t numbers = count * attribute.components;
    if (!countValues(attribute, numbers, histogram)) histogram.values.clear();
    countBins(attribute, numbers, histogram);
    return histogram;
}

} // namespace pointrt

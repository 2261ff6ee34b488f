// SPDX-License-Identifier: Apache-2.0
// Samples of the numbers of scans, for colour ranges and histograms.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/device_scene/scene_paint.h"

namespace pointrt {

/// Each scan once: sets are represented by their roots, which have a sample of their numbers.
std::vector<PlacedScan> representativesOf(const std::vector<PlacedScan>& scans);

/// The step at which visitNumbers visits about 2^18 numbers of all scans together, enough for percentiles accurate to
/// 0.1%.
std::size_t stepThrough(const std::vector<PlacedScan>& scans);

/// Calls visit(number) for the finite numbers of every step-th block of splats.
template <typename Visit>
void visitNumbers(const PlacedScan& scan, const SplatNumbers& source, std::size_t step, const Visit& visit) {
    constexpr std::size_t kBlock = 64; // many small blocks sample better than a few large ones: neighbours are alike
    double numbers[kBlock];
    const std::size_t count = scan.file->info.splat_count;
    for (std::size_t first = 0; first < count; first += kBlock * step) {
        const auto block = std::span(numbers).first(std::min(kBlock, count - first));
        readNumbers(source, first, block);
        for (const double number : block)
            if (std::isfinite(number)) visit(number);
    }
}

/// How often numbers occur.
struct NumberHistogram {
    ValueRange range;           ///< of all; low equals high if there is one number only
    std::vector<float> shares;  ///< shares of kHistogramBins equal parts of range, relative to the largest
    std::vector<double> values; ///< the distinct numbers, ascending, if they are few and integers; else empty
    bool operator==(const NumberHistogram&) const = default;
};
constexpr std::size_t kHistogramBins = 100;

/// The histogram of the numbers that word names, over all scans that have them; empty if none has. up: unit vector, for
/// heights.
NumberHistogram histogramOf(const std::vector<PlacedScan>& scans, const std::string& word, Vec3 up);

} // namespace pointrt

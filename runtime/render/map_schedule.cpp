// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/map_schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pointrt {

namespace {

/// A picture's squared error is P / maps + S / samples, and takes maps * t_map + samples * t_sample: for the least
/// error in a given time samples / maps is the root of (S t_map) / (P t_sample), so it goes with the inverse root of
/// the pixels, and with little of what else is in the scene. At this many pixels it comes to 4 (measured in
/// tests/bench/RESULTS.md, "Caustics that converge").
constexpr int kPixelBits = 18, kSampleBits = 2;

} // namespace

std::uint32_t mapOfSample(std::uint32_t sample, std::uint64_t pixels) {
    // powers of two: each map then has samples that cover a pixel evenly (shaders/lib/sampler.glsl)
    const int bits = std::bit_width(std::max<std::uint64_t>(pixels, 1) - 1);
    return sample >> std::clamp(kSampleBits + (kPixelBits - bits) / 2, 0, 31);
}

double discShrink(std::uint32_t map) {
    // of the noise so much stays from map to map that what discs blur falls as fast as the noise of the mean
    constexpr double kStays = 2.0 / 3;
    double area = 1;
    for (std::uint32_t i = 1; i <= map; ++i) area *= (i + kStays) / (i + 1);
    return std::sqrt(area);
}

} // namespace pointrt

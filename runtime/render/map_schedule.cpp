// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/map_schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pointrt {

namespace {

/// The squared error of a picture is P / maps + S / samples, and its time maps * t_map + samples * t_sample. The least
/// error in a given time has samples / maps = sqrt((S t_map) / (P t_sample)), which is proportional to the inverse root
/// of the number of pixels and depends little on the scene. At 2^kPixelBits pixels it is 2^kSampleBits (measured in
/// tests/bench/NOTES.md, "Caustics").
constexpr int kPixelBits = 18, kSampleBits = 2;

} // namespace

std::uint32_t mapOfSample(std::uint32_t sample, std::uint64_t pixels) {
    // powers of two, so that the samples of each map cover a pixel evenly (shaders/lib/sampler.glsl)
    const int bits = std::bit_width(std::max<std::uint64_t>(pixels, 1) - 1);
    return sample >> std::clamp(kSampleBits + (kPixelBits - bits) / 2, 0, 31);
}

double discShrink(std::uint32_t map) {
    // exponent at which the blur of the discs falls as fast as the noise of the mean
    constexpr double kStays = 2.0 / 3;
    double area = 1;
    for (std::uint32_t i = 1; i <= map; ++i) area *= (i + kStays) / (i + 1);
    return std::sqrt(area);
}

} // namespace pointrt

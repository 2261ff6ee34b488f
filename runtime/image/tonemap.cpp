// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt {
namespace {

constexpr float kCompressionStart = 0.8f;
constexpr float kDesaturation = 0.15f; // of the Khronos reference

// Comparisons with NaN are false, so that NaN becomes 0.
float cleanChannel(float value) { return value > 0.0f ? std::min(value, std::numeric_limits<float>::max()) : 0.0f; }

} // namespace

std::array<float, 3> toneMap(std::array<float, 3> linear) {
    for (float& channel : linear) channel = cleanChannel(channel);
    const float peak = std::max({linear[0], linear[1], linear[2]});
    if (peak < kCompressionStart) return linear;
    const float headroom = 1.0f - kCompressionStart;
    const float new_peak = 1.0f - headroom * headroom / (peak + headroom - kCompressionStart);
    const float whiteness = 1.0f - 1.0f / (kDesaturation * (peak - new_peak) + 1.0f);
    for (float& channel : linear) {
        const float scaled = channel / peak * new_peak;
        channel = scaled + (new_peak - scaled) * whiteness;
    }
    return linear;
}

std::uint8_t encodeSrgb(float linear) {
    const float x = std::clamp(cleanChannel(linear), 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * encoded));
}

Image8 tonemapFilm(const Film& film, float stops) {
    const float gain = std::exp2(stops);
    Image8 image{film.width, film.height, 3, {}};
    image.pixels.reserve(film.rgba.size() / 4 * image.channels);
    for (std::size_t i = 0; i < film.rgba.size(); i += 4)
        for (const float channel : toneMap({gain * film.rgba[i], gain * film.rgba[i + 1], gain * film.rgba[i + 2]}))
            image.pixels.push_back(encodeSrgb(channel));
    return image;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/tonemap.h"

#include <algorithm>
#include <cmath>

#include "format/base/parallel.h"
#include "shaders/shared/tone_curve.h"

namespace pointrt {
namespace {

constexpr std::size_t kPixelsAtOnce =
    1 << 14; ///< per task: a millisecond of work, ten times the cost of starting a thread

/// Clamps to [0, 1]; NaN becomes 0.
float shareOf(float value) { return std::clamp(gpu::cleanChannel(value), 0.0f, 1.0f); }

} // namespace

std::array<float, 3> toneMap(std::array<float, 3> linear) {
    for (float& channel : linear) channel = gpu::cleanChannel(channel);
    const float peak = std::max({linear[0], linear[1], linear[2]});
    if (peak < TONE_COMPRESSION_START) return linear;
    const float new_peak = gpu::compressedPeak(peak), whiteness = gpu::peakWhiteness(peak, new_peak);
    for (float& channel : linear) channel = gpu::compressHighlight(channel, peak, new_peak, whiteness);
    return linear;
}

std::uint8_t encodeSrgb(float linear) {
    const float x = shareOf(linear);
    const float encoded = x <= SRGB_LINEAR_END ? gpu::srgbLine(x) : gpu::srgbCurve(x);
    return static_cast<std::uint8_t>(std::lround(255.0f * encoded));
}

void tonemapPixels(std::span<const float> rgba, const ToneMapping& tone, std::uint8_t* bytes) {
    const float gain = std::exp2(tone.stops);
    const std::size_t pixels = rgba.size() / 4, channels = channelsOf(tone);
    forAll((pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kPixelsAtOnce, pixels);
        for (std::size_t i = part * kPixelsAtOnce; i < end; ++i) {
            const float* light = rgba.data() + 4 * i;
            const float coverage = tone.has_alpha ? shareOf(light[3]) : 1.0f;
            const float scale = coverage > 0 ? gain / coverage : 0.0f;
            const std::array<float, 3> linear = {scale * light[0], scale * light[1], scale * light[2]};
            const std::array<float, 3> shown = tone.compresses_highlights ? toneMap(linear) : linear;
            std::uint8_t* pixel = bytes + channels * i;
            for (std::size_t c = 0; c < 3; ++c) pixel[c] = encodeSrgb(shown[c]);
            if (tone.has_alpha) pixel[3] = static_cast<std::uint8_t>(std::lround(255.0f * coverage));
        }
    });
}

Image8 tonemapFilm(const Film& film, const ToneMapping& tone) {
    const std::uint32_t channels = channelsOf(tone);
    Image8 image{film.width, film.height, channels, std::vector<std::uint8_t>(film.rgba.size() / 4 * channels)};
    tonemapPixels(film.rgba, tone, image.pixels.data());
    return image;
}

} // namespace pointrt

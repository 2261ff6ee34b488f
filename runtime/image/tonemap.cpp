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
    const float x = std::clamp(gpu::cleanChannel(linear), 0.0f, 1.0f);
    const float encoded = x <= SRGB_LINEAR_END ? gpu::srgbLine(x) : gpu::srgbCurve(x);
    return static_cast<std::uint8_t>(std::lround(255.0f * encoded));
}

void tonemapPixels(std::span<const float> rgba, float stops, std::uint8_t* rgb) {
    const float gain = std::exp2(stops);
    const std::size_t pixels = rgba.size() / 4;
    forAll((pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kPixelsAtOnce, pixels);
        for (std::size_t i = part * kPixelsAtOnce; i < end; ++i) {
            const float* linear = rgba.data() + 4 * i;
            const std::array<float, 3> shown = toneMap({gain * linear[0], gain * linear[1], gain * linear[2]});
            for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = encodeSrgb(shown[c]);
        }
    });
}

Image8 tonemapFilm(const Film& film, float stops) {
    Image8 image{film.width, film.height, 3, std::vector<std::uint8_t>(film.rgba.size() / 4 * 3)};
    tonemapPixels(film.rgba, stops, image.pixels.data());
    return image;
}

} // namespace pointrt

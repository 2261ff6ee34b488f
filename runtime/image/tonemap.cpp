// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/tonemap.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/tone_curve.h"

namespace pointrt {

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

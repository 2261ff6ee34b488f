// SPDX-License-Identifier: Apache-2.0
// Tone mapping: from linear light to 8-bit sRGB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/image/film.h"
#include "runtime/image/image_png.h"

namespace pointrt {

/// How a picture's light becomes 8-bit values.
struct ToneMapping {
    float stops = 0;                   ///< exposure
    bool compresses_highlights = true; ///< false: clips them at 1, for captures that are display-encoded already
    bool has_alpha = false;            ///< RGBA, with the film's coverage as straight alpha; false: RGB
};

/// Bytes per pixel.
constexpr std::uint32_t channelsOf(const ToneMapping& tone) { return tone.has_alpha ? 4 : 3; }

/// Compresses highlights to [0, 1] (shaders/shared/tone_curve.h). Colours whose largest channel is below 0.8 are
/// unchanged. Negative and NaN values count as 0.
std::array<float, 3> toneMap(std::array<float, 3> linear);

/// The sRGB transfer function (IEC 61966-2-1), rounded to 8 bits; linear is clamped to [0, 1].
std::uint8_t encodeSrgb(float linear);

/// Tone maps linear RGBA pixels. Without has_alpha, their alpha is ignored: the background is part of the picture. With
/// has_alpha, the colour is that of the covered part of the pixel, light / coverage.
/// @param bytes room for channelsOf(tone) bytes per pixel
void tonemapPixels(std::span<const float> rgba, const ToneMapping& tone, std::uint8_t* bytes);

/// Tone maps a film in the same way.
Image8 tonemapFilm(const Film& film, const ToneMapping& tone = {});

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Tone mapping: from linear light to 8-bit sRGB.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "runtime/image/film.h"
#include "runtime/image/image_png.h"

namespace pointrt {

/// Compresses highlights to [0, 1] (shaders/shared/tone_curve.h). Colours whose largest channel is below 0.8 are
/// unchanged. Negative and NaN values count as 0.
std::array<float, 3> toneMap(std::array<float, 3> linear);

/// The sRGB transfer function (IEC 61966-2-1), rounded to 8 bits; linear is clamped to [0, 1].
std::uint8_t encodeSrgb(float linear);

/// Tone maps linear RGBA pixels, scaled by 2^stops, to RGB bytes. Ignores alpha, which is for EXR only: the background
/// is part of the picture.
/// @param rgb room for 3 bytes per pixel
void tonemapPixels(std::span<const float> rgba, float stops, std::uint8_t* rgb);

/// Tone maps a film likewise.
Image8 tonemapFilm(const Film& film, float stops = 0);

} // namespace pointrt

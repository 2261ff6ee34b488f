// SPDX-License-Identifier: Apache-2.0
// From linear light to the 8 bits of a screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "runtime/image/film.h"
#include "runtime/image/image_png.h"

namespace pointrt {

/// Compresses highlights into [0, 1] and leaves colours whose largest channel is below 0.8 as they are, by
/// shaders/shared/tone_curve.h. Negative and NaN values count as 0.
std::array<float, 3> toneMap(std::array<float, 3> linear);

/// The sRGB transfer function (IEC 61966-2-1), rounded to 8 bits; linear is clamped to [0, 1].
std::uint8_t encodeSrgb(float linear);

/// Linear pixels, 4 floats each, times 2^stops, as 3 bytes of RGB each: the background is part of the picture; alpha
/// goes to EXR only. rgb has room for them.
void tonemapPixels(std::span<const float> rgba, float stops, std::uint8_t* rgb);

/// The film's colours, times 2^stops, the same way.
Image8 tonemapFilm(const Film& film, float stops = 0);

} // namespace pointrt

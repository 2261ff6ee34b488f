// SPDX-License-Identifier: Apache-2.0
// Linear light to display values: the formulas shared by image files (C++) and the window (GLSL).
//
// Highlights are compressed into [0, 1] by the Khronos PBR Neutral tone mapper
// (https://github.com/KhronosGroup/ToneMapping, PBR_Neutral) without its toe, which removes the 4% of Fresnel
// reflection that it assumes on every surface: here, matte surfaces have none and would be too dark.
#ifndef POINTRT_SHADERS_TONE_CURVE_H
#define POINTRT_SHADERS_TONE_CURVE_H

// One channel at a time in C++, all three in GLSL, from the same text.
#ifdef __cplusplus
#include <algorithm>
#include <cmath>
#define TONE_FUNCTION inline
#define TONE_COLOR float
namespace pointrt::gpu {
using std::min;
using std::pow;
#else
#define TONE_FUNCTION
#define TONE_COLOR vec3
#endif

#define TONE_COMPRESSION_START 0.8f // colours whose largest channel is below this are unchanged
#define TONE_DESATURATION 0.15f     // of the Khronos reference
#define TONE_LARGEST_FLOAT 3.402823466e38f
#define SRGB_LINEAR_END 0.0031308f // below, the sRGB curve (IEC 61966-2-1) is a line

// Comparisons with NaN are false: NaN becomes 0.
TONE_FUNCTION float cleanChannel(float value) { return value > 0.0f ? min(value, TONE_LARGEST_FLOAT) : 0.0f; }

// The compressed value of a largest channel above TONE_COMPRESSION_START.
TONE_FUNCTION float compressedPeak(float peak) {
    float headroom = 1.0f - TONE_COMPRESSION_START;
    return 1.0f - headroom * headroom / (peak + headroom - TONE_COMPRESSION_START);
}

// How far a colour whose largest channel is compressed from peak to new_peak is blended towards white, 0 to 1.
TONE_FUNCTION float peakWhiteness(float peak, float new_peak) {
    return 1.0f - 1.0f / (TONE_DESATURATION * (peak - new_peak) + 1.0f);
}

TONE_FUNCTION TONE_COLOR compressHighlight(TONE_COLOR linear, float peak, float new_peak, float whiteness) {
    TONE_COLOR scaled = linear / peak * new_peak;
    return scaled + (new_peak - scaled) * whiteness;
}

// For values in [0, 1].
TONE_FUNCTION TONE_COLOR srgbLine(TONE_COLOR linear) { return 12.92f * linear; }
TONE_FUNCTION TONE_COLOR srgbCurve(TONE_COLOR linear) { return 1.055f * pow(linear, TONE_COLOR(1.0f / 2.4f)) - 0.055f; }

#ifdef __cplusplus
} // namespace pointrt::gpu
#else
vec3 srgbFromLinear(vec3 linear) {
    return mix(srgbCurve(linear), srgbLine(linear), lessThanEqual(linear, vec3(SRGB_LINEAR_END)));
}
#endif

#endif

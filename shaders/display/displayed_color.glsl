// SPDX-License-Identifier: Apache-2.0
// Linear light to 8-bit display values; must agree with runtime/image/tonemap.cpp, which converts files.
#ifndef POINTRT_SHADERS_DISPLAYED_COLOR_GLSL
#define POINTRT_SHADERS_DISPLAYED_COLOR_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/display_layout.h"
#include "shaders/shared/tone_curve.h"

vec3 toneMap(vec3 linear) {
    float peak = largest(linear), new_peak = compressedPeak(peak);
    vec3 compressed = compressHighlight(linear, peak, new_peak, peakWhiteness(peak, new_peak));
    return peak < TONE_COMPRESSION_START ? linear : compressed;
}

vec3 encodeSrgb(vec3 linear) { return srgbFromLinear(clamp(linear, 0.0, 1.0)); }

// 0xAARRGGBB, the format of windows. display: DISPLAY_*.
uint displayedColor(vec3 color, uint display) {
    color = vec3(cleanChannel(color.r), cleanChannel(color.g), cleanChannel(color.b));
    if (display == DISPLAY_COMPRESSED) color = toneMap(color);
    vec3 encoded = display == DISPLAY_AS_STORED ? clamp(color, 0.0, 1.0) : encodeSrgb(color);
    uvec3 bytes = uvec3(encoded * 255.0 + 0.5);
    return bytes.b | bytes.g << 8 | bytes.r << 16 | 0xFF000000u;
}

#endif

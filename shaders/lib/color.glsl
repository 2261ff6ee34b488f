// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_COLOR_GLSL
#define POINTRT_SHADERS_COLOR_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/luminance.h"

// Decodes sRGB by a cubic, within 0.002 of the exact power function (Chilliant 2012), and faster.
vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

// The exact curve of IEC 61966-2-1, for colours that are encoded again.
vec3 exactLinearFromSrgb(vec3 c) {
    return mix(pow((max(c, vec3(0.04)) + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_COLOR_GLSL
#define POINTRT_SHADERS_COLOR_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/luminance.h"

// Exact sRGB decoding is a power each; the cubic agrees within 0.002 (Chilliant 2012).
vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_COLOR_GLSL
#define POINTRT_SHADERS_COLOR_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/luminance.h"

// Decodes sRGB by a cubic, within 0.002 of the exact power function (Chilliant 2012), and faster.
vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

#endif

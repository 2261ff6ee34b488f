// SPDX-License-Identifier: Apache-2.0
// From linear light to the 8 bits of a screen: the same as runtime/image/tonemap.cpp does for files.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/display_layout.h"
#include "shaders/math/math.glsl"
#include "shaders/shared/bindings.h"

layout(local_size_x = DISPLAY_GROUP) in;
layout(push_constant) uniform Push { TonemapParams push; };

layout(binding = BINDING_TONEMAP_COLORS) uniform samplerBuffer colors;
// 0xAARRGGBB, as windows take them
layout(std430, binding = BINDING_TONEMAP_PIXELS) writeonly buffer PixelBuffer { uint pixels[]; };

// As in runtime/image/tonemap.cpp.
const float kCompressionStart = 0.8, kDesaturation = 0.15, kGreatest = 3.402823466e38;

// Comparisons with NaN are false, so that NaN becomes 0.
float cleanChannel(float value) { return value > 0.0 ? min(value, kGreatest) : 0.0; }

// Khronos PBR Neutral without its toe.
vec3 toneMap(vec3 linear) {
    float peak = largest(linear), headroom = 1.0 - kCompressionStart;
    float new_peak = 1.0 - headroom * headroom / (peak + headroom - kCompressionStart);
    float whiteness = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
    vec3 scaled = linear / peak * new_peak;
    return peak < kCompressionStart ? linear : scaled + (new_peak - scaled) * whiteness;
}

vec3 encodeSrgb(vec3 linear) {
    vec3 x = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint pixel = push.first + gl_GlobalInvocationID.x;
    vec3 color = texelFetch(colors, int(pixel)).rgb * push.gain;
    color = vec3(cleanChannel(color.r), cleanChannel(color.g), cleanChannel(color.b));
    vec3 encoded = push.is_light != 0u ? encodeSrgb(toneMap(color)) : clamp(color, 0.0, 1.0);
    uvec3 bytes = uvec3(encoded * 255.0 + 0.5);
    pixels[pixel] = bytes.b | bytes.g << 8 | bytes.r << 16 | 0xFF000000u;
}

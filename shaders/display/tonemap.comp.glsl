// SPDX-License-Identifier: Apache-2.0
// Linear light to 8-bit display values, as runtime/image/tonemap.cpp does for files.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/display_layout.h"
#include "shaders/shared/tone_curve.h"
#include "shaders/lib/math.glsl"
#include "shaders/shared/bindings.h"

layout(local_size_x = DISPLAY_GROUP) in;
layout(push_constant) uniform Push { TonemapParams push; };

layout(binding = BINDING_TONEMAP_COLORS) uniform samplerBuffer colors;
// 0xAARRGGBB, the format of windows
layout(std430, binding = BINDING_TONEMAP_PIXELS) writeonly buffer PixelBuffer { uint pixels[]; };

vec3 toneMap(vec3 linear) {
    float peak = largest(linear), new_peak = compressedPeak(peak);
    vec3 compressed = compressHighlight(linear, peak, new_peak, peakWhiteness(peak, new_peak));
    return peak < TONE_COMPRESSION_START ? linear : compressed;
}

vec3 encodeSrgb(vec3 linear) { return srgbFromLinear(clamp(linear, 0.0, 1.0)); }

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint pixel = push.first + gl_GlobalInvocationID.x;
    vec3 color = texelFetch(colors, int(pixel)).rgb * push.gain;
    color = vec3(cleanChannel(color.r), cleanChannel(color.g), cleanChannel(color.b));
    if (push.display == DISPLAY_COMPRESSED) color = toneMap(color);
    vec3 encoded = push.display == DISPLAY_AS_STORED ? clamp(color, 0.0, 1.0) : encodeSrgb(color);
    uvec3 bytes = uvec3(encoded * 255.0 + 0.5);
    pixels[pixel] = bytes.b | bytes.g << 8 | bytes.r << 16 | 0xFF000000u;
}

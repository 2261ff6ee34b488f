// SPDX-License-Identifier: Apache-2.0
// Converts light, or other parts of the film, to the pixels of the window.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/displayed_color.glsl"
#include "shaders/shared/bindings.h"

layout(local_size_x = DISPLAY_GROUP) in;
layout(push_constant) uniform Push { TonemapParams push; };

layout(binding = BINDING_TONEMAP_COLORS) uniform samplerBuffer colors;
layout(std430, binding = BINDING_TONEMAP_PIXELS) writeonly buffer PixelBuffer { uint pixels[]; };

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint pixel = push.first + gl_GlobalInvocationID.x;
    pixels[pixel] = displayedColor(texelFetch(colors, int(pixel)).rgb * push.gain, push.display);
}

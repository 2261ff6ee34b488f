// SPDX-License-Identifier: Apache-2.0
#version 460
// Colours of the user interface: sRGB-encoded like the picture below, straight alpha.

layout(location = 0) in vec2 glyph;
layout(location = 1) in vec4 color;
layout(binding = 0) uniform sampler2D font;

layout(location = 0) out vec4 color_out;

void main() { color_out = color * texture(font, glyph); }

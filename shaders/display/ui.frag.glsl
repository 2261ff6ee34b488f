// SPDX-License-Identifier: Apache-2.0
#version 460
// The UI's colours: sRGB-encoded, straight alpha, as the picture underneath.

layout(location = 0) in vec2 glyph;
layout(location = 1) in vec4 color;
layout(binding = 0) uniform sampler2D font;

layout(location = 0) out vec4 color_out;

void main() { color_out = color * texture(font, glyph); }

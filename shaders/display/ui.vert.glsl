// SPDX-License-Identifier: Apache-2.0
#version 460
// Triangles of the user interface, in window units from the upper left corner (ui_renderer.h).

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 glyph;
layout(location = 2) in vec4 color;

layout(push_constant) uniform Push {
    vec2 scale, offset; // clip space from window units
};

layout(location = 0) out vec2 glyph_out;
layout(location = 1) out vec4 color_out;

void main() {
    gl_Position = vec4(position * scale + offset, 0, 1);
    glyph_out = glyph;
    color_out = color;
}

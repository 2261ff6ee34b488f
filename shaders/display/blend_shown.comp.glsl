// SPDX-License-Identifier: Apache-2.0
// Blends pixels of the film's picture over the reprojected one. A lane for each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

void main() {
    if (lane() >= push.count) return;
    uint pixel = push.first + lane();
    pixels[pixel] = mixColors(shown[pixel], pixels[pixel], uint(256.0 * push.share + 0.5));
}

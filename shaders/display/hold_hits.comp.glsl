// SPDX-License-Identifier: Apache-2.0
// First hits of the listed pixels as new points. A lane for each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/hit_point.glsl"

void main() {
    if (lane() >= push.count) return;
    uint word = pixel_list[lane()];
    uvec2 place = uvec2(word & 0xFFFFu, word >> 16);
    HitPoint point = hitPoint(place, push.first + lane());
    new_points[pixelAt(place)] = vec4(point.position, uintBitsToFloat(point.info | POINT_MAX_SAMPLES << POINT_SAMPLES_SHIFT));
    new_depths[pixelAt(place)] = point.depth;
}

// SPDX-License-Identifier: Apache-2.0
// Takes the colours of the visible points from the full picture of the last view. Removes hidden points, whose new
// colours are unknown. A lane for each place in the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

void main() {
    if (lane() < pixelCount() && hasPoint(lane())) point_colors[seen[lane()]] = pixels[lane()];
    if (lane() < pointCount() && is_visible[lane()] == 0u)
        points[lane()].w = uintBitsToFloat(infoOf(lane()) | POINT_INVALID);
}

// SPDX-License-Identifier: Apache-2.0
// Replaces all points by the new ones. A lane for each place in the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

void main() {
    if (lane() >= params.points) return;
    if ((push.bits & REPROJECT_IF_GAPS) != 0u && control.gaps <= params.most_gaps) return;
    if (lane() == 0u) {
        control.point_count = pixelCount();
        control.cursor = 0u;
    }
    bool is_pixel = lane() < pixelCount();
    vec4 point = is_pixel ? new_points[lane()] : vec4(vec3(0.0), uintBitsToFloat(POINT_INVALID));
    bool is_gone = (floatBitsToUint(point.w) & POINT_INVALID) != 0u;
    points[lane()] = point;
    is_visible[lane()] = is_gone ? 0u : 1u;
    if (!is_pixel) return;
    point_colors[lane()] = shown[lane()];
    seen[lane()] = is_gone ? NO_INDEX : lane();
    nearest[lane()] = is_gone ? uvec2(NO_INDEX) : uvec2(floatBitsToUint(new_depths[lane()]), lane());
}

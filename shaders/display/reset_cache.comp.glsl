// SPDX-License-Identifier: Apache-2.0
// Empties pixels and tiles before points are projected. A lane for each place in the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

void removePoints() {
    if (lane() == 0u) control = ReprojectionControl(0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0u);
    points[lane()] = vec4(vec3(0.0), uintBitsToFloat(POINT_INVALID));
    if (lane() < pixelCount()) seen[lane()] = NO_INDEX;
    if (lane() < params.tiles_across * params.tiles_down) {
        errors[lane()] = 0.0;
        recorded[lane()] = 0u;
    }
}

void main() {
    if (lane() >= params.points) return;
    if (lane() == 0u) control.empty = 0u;
    if (lane() < params.tiles_across * params.tiles_down) tiles[lane()] = TileColors(0u, 0u, 0u, 0u, 0u);
    if ((push.bits & REPROJECT_KEEPS_POINTS) != 0u) return;
    if (lane() < pixelCount()) nearest[lane()] = uvec2(NO_INDEX);
    is_visible[lane()] = 0u;
    if ((push.bits & REPROJECT_CLEARS) != 0u) removePoints();
}

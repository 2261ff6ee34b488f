// SPDX-License-Identifier: Apache-2.0
// The first of the points at the nearest depth in a pixel becomes visible. A lane for each point.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

void main() {
    if (lane() >= pointCount()) return;
    uvec2 at = projected[lane()];
    if (at.x != NO_INDEX && nearest[at.x].x == at.y) atomicMin(nearest[at.x].y, lane());
}

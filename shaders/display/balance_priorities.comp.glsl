// SPDX-License-Identifier: Apache-2.0
// Finds the probability per priority that selects as many pixels as wanted on average. One workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/group_sum.glsl"

void main() {
    vec2 part = vec2(0.0);
    for (uint row = gl_LocalInvocationID.x; row < params.tiles_down; row += REPROJECT_GROUP)
        part += vec2(row_sums[row].priority, row_sums[row].certain);
    vec2 sum = groupSum(part);
    if (gl_LocalInvocationID.x != 0u || control.is_balanced != 0u) return;
    float left = float(params.selected) - sum.y;
    if (sum.x > 0.0 && left > 0.0)
        control.probability = left / sum.x;
    else
        control.is_balanced = 1u;
}

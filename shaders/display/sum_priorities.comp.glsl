// SPDX-License-Identifier: Apache-2.0
// Sums the priorities of pixels that are not certain to be selected, and counts those that are. A workgroup for each row
// of tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/considered.glsl"
#include "shaders/display/group_sum.glsl"

void main() {
    uint tile_row = gl_WorkGroupID.x, row = tile_row * consideredOfRow();
    vec2 sum = vec2(0.0);
    for (uint i = gl_LocalInvocationID.x; i < consideredOfRow(); i += REPROJECT_GROUP) {
        float priority = priorities[row + i];
        sum += priority * control.probability < 1.0 ? vec2(priority, 0.0) : vec2(0.0, 1.0);
    }
    vec2 total = groupSum(sum);
    if (gl_LocalInvocationID.x == 0u) row_sums[tile_row] = RowSum(total.x, total.y);
}

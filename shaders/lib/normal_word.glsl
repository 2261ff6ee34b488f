// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_NORMAL_WORD_GLSL
#define POINTRT_SHADERS_NORMAL_WORD_GLSL
#include "pointrt/pro_layout.h"

// A normal of any length as splats encode theirs: the octahedral map (format/SPEC.md).
uint normalWord(vec3 normal) {
    vec3 n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 folded = mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0))) * (1.0 - abs(n.yx));
    uvec2 codes = uvec2((0.5 * (n.z < 0.0 ? folded : n.xy) + 0.5) * PRO_NORMAL_STEPS + 0.5);
    return min(codes.x, PRO_NORMAL_MASK) | min(codes.y, PRO_NORMAL_MASK) << PRO_NORMAL_BITS;
}

#endif

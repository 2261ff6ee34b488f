// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_GROUP_SUM_GLSL
#define POINTRT_SHADERS_GROUP_SUM_GLSL
#include "shaders/display/point_cache.glsl"

shared vec2 parts[REPROJECT_GROUP];

// The sum over the workgroup, whose lanes all call it once.
vec2 groupSum(vec2 part) {
    uint i = gl_LocalInvocationID.x;
    parts[i] = part;
    for (uint half_size = REPROJECT_GROUP / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (i < half_size) parts[i] += parts[i + half_size];
    }
    barrier();
    return parts[0];
}

#endif

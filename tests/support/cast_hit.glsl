// SPDX-License-Identifier: Apache-2.0
// The hit of a lane of a probe program.
#ifndef POINTRT_TESTS_CAST_HIT_GLSL
#define POINTRT_TESTS_CAST_HIT_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/trace/splat.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

bool isRay(out uint ray) {
    ray = gl_GlobalInvocationID.x;
    return ray < control.queued[0];
}

bool castHit(uint ray, out uvec4 hit) {
    hit = loadHit(ray);
    return hit.z != NO_INDEX;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Any-hit intersection of a shadow ray with one instance.
#ifndef POINTRT_SHADERS_OCCLUSION_GLSL
#define POINTRT_SHADERS_OCCLUSION_GLSL
#define ANY_HIT
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

// A ray with negative t_max hits nothing.
bool isOccluded(ShadowRay ray) {
    TraceRay in_cube = secondaryRay(ray.origin, ray.direction, ray.t_max * cubeScale(), ray.self_normal, ray.owner,
                                    ray.self_t);
    return trace(in_cube).disc != NO_INDEX;
}

#endif

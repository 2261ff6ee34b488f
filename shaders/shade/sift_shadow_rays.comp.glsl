// SPDX-License-Identifier: Apache-2.0
// Which targets of a sieve the fused form's shadow rays may meet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/shadow_ray.glsl"
#include "shaders/trace/sift.glsl"

void main() {
    uint lane = balancedLane(), path = listEntry(lane);
    ShadowRay ray = loadShadowRay(path != NO_INDEX ? path : 0u);
    sift(lane, path != NO_INDEX, ray.origin, ray.direction, ray.t_max);
}

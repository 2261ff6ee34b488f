// SPDX-License-Identifier: Apache-2.0
// Culls the megakernel's stored shadow rays against the boxes of a group of instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/shadow_ray.glsl"
#include "shaders/trace/cull.glsl"

void main() {
    uint lane = balancedLane(), path = listEntry(lane);
    bool live = path != NO_INDEX;
    ShadowRay ray = loadShadowRay(live ? path : 0u);
    cullEntry(lane, live, ray.origin, ray.direction, ray.t_max);
}

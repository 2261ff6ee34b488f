// SPDX-License-Identifier: Apache-2.0
// Culls the shadow rays of LIST_SHADOW_RAYS against the boxes of a group of instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/cull.glsl"

void main() {
    uint lane = balancedLane(), entry = listEntry(lane);
    bool live = entry != NO_INDEX;
    ShadowRay ray = shadowRayOfEntry(live ? entry : 0u);
    cullEntry(lane, live, ray.origin, ray.direction, ray.t_max);
}

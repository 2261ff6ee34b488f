// SPDX-License-Identifier: Apache-2.0
// Which targets of a sieve the shadow rays listed for instances may meet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/sift.glsl"

void main() {
    uint lane = balancedLane(), entry = listEntry(lane);
    bool live = entry != NO_INDEX;
    entry = live ? entry : 0u;
    TurnRay ray = turnRay(loadLightQuery(turnPath(entry)), entry);
    sift(lane, live, ray.origin, ray.direction, ray.t_max);
}

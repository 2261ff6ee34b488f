// SPDX-License-Identifier: Apache-2.0
// Which lights do not reach the points that ask for them because an instance stands between.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

bool isStopped(DirectLightQuery query, TurnRay ray) {
    bool own = query.owner == instance.materials.x;
    vec3 stored_normal = query.normal * query.side;
    return trace(TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, ray.t_max * cubeScale(),
                          cubeDirection(stored_normal), own ? ray.own_t * cubeScale() : 0.0)).disc != NO_INDEX;
}

void main() {
    uint entry = listEntry(balancedLane());
    if (entry == NO_INDEX) return;
    DirectLightQuery query = loadLightQuery(turnPath(entry));
    if (isStopped(query, turnRay(query, entry))) atomicOr(light_masks[turnPath(entry)], 1u << turnOf(entry));
}

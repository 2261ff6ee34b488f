// SPDX-License-Identifier: Apache-2.0
// Which lights do not reach the points that ask for them because an instance stands between.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/light/direct_light.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/trace/offset.glsl"

bool isShadowed(DirectLightQuery query, LightSample to, bool asks) {
    float own_t;
    vec3 origin = leaveSurface(query.position, query.normal, query.radius, query.material, to.direction, own_t);
    bool own = query.owner == instance.materials.x;
    float t_max = asks ? to.distance * kBeforeLamp * cubeScale() : -1.0;
    vec3 stored_normal = query.normal * query.side;
    return trace(TraceRay(cubePoint(origin), cubeDirection(to.direction), 0.0, t_max, cubeDirection(stored_normal),
                          own ? own_t * cubeScale() : 0.0)).disc != NO_INDEX;
}

void main() {
    uint entry = turnEntry(balancedLane());
    if (entry == NO_INDEX) return;
    uint turn = entry >> ASKED_TURN_SHIFT, path = entry & (1u << ASKED_TURN_SHIFT) - 1u;
    DirectLightQuery query = loadLightQuery(path);
    Light light;
    LightSample to = sampleTurn(query, path, turn, light);
    // another instance may have answered already
    bool asks = (light_masks[path] >> turn & 1u) == 0u;
    if (isShadowed(query, to, asks)) atomicOr(light_masks[path], 1u << turn);
}

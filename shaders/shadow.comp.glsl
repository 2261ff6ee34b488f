// SPDX-License-Identifier: Apache-2.0
// Which lights do not reach the lit points because an instance stands between.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "direct_light.glsl"
#include "splat.glsl"
#include "trace.glsl"
#include "offset.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

bool isShadowed(LitPoint point, LightSample to, bool asks) {
    float own_t;
    vec3 origin = leaveSurface(point.position.xyz, point.normal.xyz, point.position.w, to.direction, own_t);
    bool own = floatBitsToUint(point.albedo.w) == instance.materials.x;
    float t_max = asks ? to.distance * kBeforeLamp * cubeScale() : -1.0;
    vec3 stored_normal = point.normal.xyz * point.view.w;
    return trace(TraceRay(cubePoint(origin), cubeDirection(to.direction), 0.0, t_max, cubeDirection(stored_normal),
                          own ? own_t * cubeScale() : 0.0)).near != NO_INDEX;
}

void main() {
    uint path;
    LitPoint point = litPoint(path);
    bool live = path != NO_INDEX;
    uint turns = lightTurns(), mask = live ? light_masks[path] : 0xFFFFFFFFu;
    for (uint turn = 0u; turn < turns; turn++) {
        Light light;
        LightSample to = sampleTurn(point, live ? path : 0u, turn, light);
        bool asks = (mask >> turn & 1u) == 0u;
        bool dark = isShadowed(point, to, asks);
        mask |= asks && dark ? 1u << turn : 0u;
    }
    if (live) light_masks[path] = mask;
}

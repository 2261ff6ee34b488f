// SPDX-License-Identifier: Apache-2.0
// Light from all point lights on the lit points, with a shadow ray each.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#define ANY_HIT
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"
#include "offset.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// What a light would add to a lit point if nothing stood between.
vec3 lightFrom(LitPoint point, vec3 direction, float cosine, vec3 radiance) {
    vec3 mirrored = reflect(-direction, point.normal.xyz);
    float highlight = pow(max(dot(mirrored, point.view.xyz), 0.0), point.normal.w) * point.diffuse.w;
    return radiance * (point.diffuse.rgb * cosine + highlight);
}

bool isShadowed(LitPoint point, vec3 direction, float distance_to_light, bool asks) {
    float own_t;
    vec3 origin = leaveSurface(point.position.xyz, point.normal.xyz, point.position.w, direction, own_t);
    vec3 own_normal = point.position.w > 0.0 ? point.normal.xyz : vec3(0.0);
    float t_max = asks ? distance_to_light : -1.0;
    return trace(TraceRay(origin, direction, 0.0, t_max, own_normal, own_t)).near != NO_INDEX;
}

void main() {
    uint lane = balancedLane();
    bool live = lane < control.queued.w;
    uint path = live ? queues[litQueueStart() + lane] : 0u;
    LitPoint point = lit_points[path];
    bool shadows = hasOption(OPTION_SHADOWS);
    vec3 light = vec3(0.0);
    uint rays = 0u;
    for (uint l = 0u; l < params.scene.x; l++) {
        vec3 to_light = params.light_position[l].xyz - point.position.xyz;
        float distance_to_light = length(to_light);
        vec3 direction = to_light / distance_to_light;
        float cosine = dot(point.normal.xyz, direction);
        bool faces = live && cosine > 0.0, asks = faces && shadows;
        bool dark = isShadowed(point, direction, distance_to_light, asks);
        vec3 radiance = params.light_power[l].xyz / (distance_to_light * distance_to_light);
        light += faces && !(asks && dark) ? lightFrom(point, direction, cosine, radiance) : vec3(0.0);
        rays += asks ? 1u : 0u;
    }
    rays = subgroupAdd(rays);
    if (subgroupElect() && rays > 0u) atomicAdd(control.traced.y, rays);
    if (live) film[path].rgb += light;
}

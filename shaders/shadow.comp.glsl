// SPDX-License-Identifier: Apache-2.0
// Light from one point light on the lit points, with a shadow ray each.
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

void main() {
    uint lane = balancedLane();
    uint light = push.step.z >> 16;
    bool live = lane < control.queued.w;
    uint path = live ? queues[litQueueStart() + lane] : 0u;
    LitPoint point = lit_points[path];
    vec3 to_light = params.light_position[light].xyz - point.position.xyz;
    float distance_to_light = length(to_light);
    vec3 direction = to_light / distance_to_light;
    float cosine = dot(point.normal.xyz, direction);
    live = live && cosine > 0.0;

    bool shadows = hasOption(OPTION_SHADOWS);
    uint rays = subgroupAdd(live && shadows ? 1u : 0u);
    if (subgroupElect() && rays > 0u) atomicAdd(control.traced.y, rays);

    bool visible = live;
    if (live && shadows) {
        float own_t;
        vec3 origin = leaveSurface(point.position.xyz, point.normal.xyz, point.position.w, direction, own_t);
        vec3 own_normal = point.position.w > 0.0 ? point.normal.xyz : vec3(0.0);
        visible = trace(TraceRay(origin, direction, distance_to_light, own_normal, own_t)).splat == NO_INDEX;
    }
    if (!visible) return;
    vec3 power = params.light_power[light].xyz / (distance_to_light * distance_to_light);
    vec3 mirrored = reflect(-direction, point.normal.xyz);
    float highlight = pow(max(dot(mirrored, point.view.xyz), 0.0), point.normal.w) * point.diffuse.w;
    film[path].rgb += power * (point.diffuse.rgb * cosine + highlight);
}

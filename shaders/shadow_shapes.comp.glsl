// SPDX-License-Identifier: Apache-2.0
// Which lights reach the lit points, as far as the surfaces' own facing and shapes say.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "direct_light.glsl"
#include "shapes.glsl"
#include "offset.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// A lamp is not hidden by itself: its distance from here and as a shape differ by rounding.
bool shapesHide(LitPoint point, LightSample to, uint lamp) {
    float own_t;
    vec3 origin = leaveSurface(point.position.xyz, point.normal.xyz, point.position.w, to.direction, own_t);
    bool on_shape = floatBitsToUint(point.albedo.w) == OWNER_SHAPES;
    float t_min = on_shape ? ownShapeReach(origin) : 0.0;
    ShapeHit hit = nearestShape(params.scene.z, origin, to.direction, t_min);
    return hit.shape != lamp && hit.t < to.distance * kBeforeLamp;
}

void main() {
    uint path;
    LitPoint point = litPoint(path);
    bool live = path != NO_INDEX, shadows = hasOption(OPTION_SHADOWS);
    uint turns = lightTurns(), mask = 0u, asked = 0u;
    for (uint turn = 0u; turn < turns; turn++) {
        Light light;
        LightSample to = sampleTurn(point, live ? path : 0u, turn, light);
        bool faces = live && facesLight(point, to);
        bool dark = !faces || (shadows && shapesHide(point, to, lampOf(light)));
        mask |= dark ? 1u << turn : 0u;
        asked += faces && shadows ? 1u : 0u;
    }
    asked = subgroupAdd(asked);
    if (subgroupElect() && asked > 0u) atomicAdd(control.traced.y, asked);
    if (live) light_masks[path] = mask;
}

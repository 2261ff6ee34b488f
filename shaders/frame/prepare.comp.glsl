// SPDX-License-Identifier: Apache-2.0
// One lane between dispatches: turns queue lengths into the group counts of the next ones and
// counts their rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame/bindings.glsl"

layout(local_size_x = 1) in;

uvec4 groupsFor(uint lanes) { return uvec4((lanes + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE, 1u, 1u, 0u); }

void main() {
    if (hasStep(STEP_RESET)) {
        control.queued = uvec4(0u);
        control.ray_groups = groupsFor(bandLanes());
        control.tile_groups = uvec4(0u, 1u, 1u, 0u);
        control.light_groups = groupsFor(0u);
        control.asked_groups = groupsFor(0u);
        control.hit_groups = groupsFor(0u);
        control.appended = uvec4(0u);
        control.traced = uvec4(params.image.x * params.image.w, 0u, 0u, 0u);
        return;
    }
    if (hasStep(STEP_ASKED)) {
        control.asked_groups = uvec4(groupsFor(control.appended.x).xyz, control.appended.x);
        control.appended.x = 0u;
        return;
    }
    if (hasStep(STEP_HITS)) {
        control.hit_groups = uvec4(groupsFor(control.appended.y).xyz, control.appended.y);
        control.appended.y = 0u;
        return;
    }
    // the queue just shaded is empty again; the other holds the next rays
    bool second = hasStep(STEP_QUEUE_ONE);
    uint next = second ? control.queued.x : control.queued.y;
    uint lit = control.queued.z;
    control.traced.z += next;
    control.queued = uvec4(second ? next : 0u, second ? 0u : next, 0u, lit);
    control.ray_groups = groupsFor(next);
    control.light_groups = groupsFor(lit);
}

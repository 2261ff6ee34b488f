// SPDX-License-Identifier: Apache-2.0
// One lane between dispatches: turns queue lengths into the group counts of the next ones and
// counts their rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame/bindings.glsl"

layout(local_size_x = 1) in;

uvec3 groupsFor(uint lanes) { return uvec3((lanes + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE, 1u, 1u); }

void reset() {
    control.queued[0] = 0u;
    control.queued[1] = 0u;
    control.light_queries_appended = 0u;
    control.light_query_count = 0u;
    control.ray_groups = groupsFor(bandLanes());
    control.tile_groups = groupsFor(0u);
    control.tile_count = 0u;
    control.light_groups = groupsFor(0u);
    control.asked_groups = groupsFor(0u);
    control.asked_count = 0u;
    control.turn_groups = groupsFor(0u);
    control.turn_count = 0u;
    control.turns_appended = 0u;
    control.hit_groups = groupsFor(0u);
    control.hit_count = 0u;
    control.asked_appended = 0u;
    control.hits_appended = 0u;
    control.primary_rays = params.width * params.rows;
    control.shadow_rays = 0u;
    control.secondary_rays = 0u;
}

// The queue just shaded is empty again; the other holds the next rays.
void takeNextQueue() {
    bool second = hasStep(STEP_QUEUE_ONE);
    uint next = control.queued[second ? 0 : 1], queries = control.light_queries_appended;
    control.secondary_rays += next;
    control.queued[second ? 1 : 0] = 0u;
    control.light_queries_appended = 0u;
    control.light_query_count = queries;
    control.ray_groups = groupsFor(next);
    control.light_groups = groupsFor(queries);
}

void main() {
    if (hasStep(STEP_RESET)) {
        reset();
    } else if (hasStep(STEP_ASKED)) {
        control.asked_groups = groupsFor(control.asked_appended);
        control.asked_count = control.asked_appended;
        control.asked_appended = 0u;
    } else if (hasStep(STEP_TURNS)) {
        control.turn_groups = groupsFor(control.turns_appended);
        control.turn_count = control.turns_appended;
        control.turns_appended = 0u;
    } else if (hasStep(STEP_HITS)) {
        control.hit_groups = groupsFor(control.hits_appended);
        control.hit_count = control.hits_appended;
        control.hits_appended = 0u;
    } else {
        takeNextQueue();
    }
}

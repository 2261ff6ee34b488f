// SPDX-License-Identifier: Apache-2.0
// First hits of the queued rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void countRays(bool live) {
    uint rays = subgroupAdd(live ? 1u : 0u);
    if (!subgroupElect() || rays == 0u || hasStep(STEP_FIRST_HIT)) return;
    if ((push.step.z & 0xFFFFu) == 0u) atomicAdd(control.traced.x, rays);
    else atomicAdd(control.traced.z, rays);
}

void main() {
    uint path = queuedPath(balancedLane());
    countRays(path != NO_INDEX);
    if (path == NO_INDEX) return;
    PathState state = paths[path];
    TraceHit hit = trace(TraceRay(state.origin.xyz, state.direction.xyz, 1e30, state.left_normal.xyz, state.origin.w));
    hits[path] = uvec4(floatBitsToUint(hit.t), hit.cell, hit.splat, 0u);
}

// SPDX-License-Identifier: Apache-2.0
// Any hits of the queued rays: what shaders/shadow.comp.glsl traces, without its light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint path = queuedPath(balancedLane());
    if (path == NO_INDEX) return;
    PathState state = paths[path];
    TraceHit hit = trace(TraceRay(state.origin.xyz, state.direction.xyz, 1e30, state.left_normal.xyz, state.origin.w));
    hits[path] = uvec4(floatBitsToUint(hit.t), hit.cell, hit.splat, 0u);
}

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
    uint path = queuedIndex(balancedLane());
    if (path == NO_INDEX) return;
    vec4 origin = loadPathTexel(path, PATH_ORIGIN);
    TraceHit hit = trace(TraceRay(origin.xyz, loadPathTexel(path, PATH_DIRECTION).xyz, 0.0, 1e30,
                                  loadPathTexel(path, PATH_LEFT_NORMAL).xyz, origin.w));
    storeHit(path, uvec4(floatBitsToUint(hit.t), hit.cell, hit.near, 0u));
}

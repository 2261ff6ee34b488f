// SPDX-License-Identifier: Apache-2.0
// What shading makes of traced hits before it blends: first_hits gets the exact distance and, as bits, the splat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame/bindings.glsl"
#include "shaders/trace/splat.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= control.queued[0]) return;
    uvec4 hit = loadHit(i);
    first_hits[i] = vec4(0.0, uintBitsToFloat(NO_INDEX), 0.0, 0.0);
    if (hit.z == NO_INDEX) return;
    uint splat = loadListed(hit.z);
    float t = exactDistance(hit, loadSplat(splat), paths[i].origin, paths[i].direction);
    first_hits[i] = vec4(t, uintBitsToFloat(splat), 0.0, 0.0);
}

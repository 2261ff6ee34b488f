// SPDX-License-Identifier: Apache-2.0
// Traced hits refined but not blended: first_hits gets the exact distance and, as bits, the splat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/support/cast_hit.glsl"

void main() {
    uint i;
    uvec4 hit;
    if (!isRay(i)) return;
    first_hits[i] = vec4(0.0, uintBitsToFloat(NO_INDEX), 0.0, 0.0);
    if (!castHit(i, hit)) return;
    uint splat = loadListed(hit.z);
    float t = exactDistance(hit, loadSplat(splat), paths[i].origin, paths[i].direction);
    first_hits[i] = vec4(t, uintBitsToFloat(splat), 0.0, 0.0);
}

// SPDX-License-Identifier: Apache-2.0
// First hits of a batch of rays with one instance: the disc, as it is, without its neighbours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/cast/cast_rays.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    CastRay ray = loadCastRay(row);
    CastHit nearest = CastHit(ray.t_max, NO_INDEX, 0u, 0u);
    TraceRay in_cube = instanceRay(ray);
    TraceHit hit = trace(in_cube);
    if (hit.disc != NO_INDEX) {
        uint splat = loadListed(hit.disc);
        uvec4 words = loadSplat(splat), found = uvec4(floatBitsToUint(hit.t), hit.cell, hit.disc, 0u);
        float t = exactDistance(found, words, in_cube.origin, in_cube.direction);
        nearest = CastHit(t / cubeScale(), splat, words.z, 0u);
    }
    storeCastHit(row, nearest);
}

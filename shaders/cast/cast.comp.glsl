// SPDX-License-Identifier: Apache-2.0
// Closest hits of a batch of rays with one instance: the flat disc, not blended with its neighbours, or the ball.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/cast/cast_rays.glsl"
#include "shaders/lib/normal_word.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    LoadedRay loaded = loadRay(row);
    float t = loaded.ray.t_max;
    uint splat = NO_INDEX, normal = 0u;
    TraceRay in_cube = instanceRay(loaded.ray);
    TraceHit hit = trace(in_cube);
    if (hit.disc != NO_INDEX) {
        splat = loadListed(hit.disc);
        uvec4 words = loadSplat(splat), found = uvec4(floatBitsToUint(hit.t), hit.cell, hit.disc, 0u);
        float t_cube = exactDistance(found, words, in_cube.origin, in_cube.direction);
        t = t_cube / unitsInCube();
        normal = words.z;
        if (isBall(words)) normal = normalWord(in_cube.origin + t_cube * in_cube.direction - splatPosition(words));
    }
    storeHit(row, loaded, t, splat, normal);
}

// SPDX-License-Identifier: Apache-2.0
// The closest hits of paths so far.
#ifndef POINTRT_SHADERS_STORE_HIT_GLSL
#define POINTRT_SHADERS_STORE_HIT_GLSL

// t_max of the ray of a path, in cube units: the closest hit so far.
float maxDistance(uint path) { return uintBitsToFloat(loadHit(path).x) * cubeScale(); }

// A hit in the format of hit_texels, with t in render units.
uvec4 storedHit(TraceHit hit) {
    return uvec4(floatBitsToUint(hit.t / cubeScale()), hit.cell, hit.disc, instance.materials.x);
}

// Stores a hit that is nearer than the closest one so far, and appends the path to the hit list for the program
// surface.
void storeHit(bool hits, uint path, uvec4 hit) {
    if (hits) imageStore(hit_texels, int(path), hit);
    appendEntry(APPEND_HIT, hits, path);
}

void storeHit(bool live, uint path, TraceHit hit) {
    storeHit(live && hit.disc != NO_INDEX, path, storedHit(hit));
}

#endif

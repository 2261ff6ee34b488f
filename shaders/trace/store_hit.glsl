// SPDX-License-Identifier: Apache-2.0
// Closest hits of paths so far.
#ifndef POINTRT_SHADERS_STORE_HIT_GLSL
#define POINTRT_SHADERS_STORE_HIT_GLSL

// t_max of the ray of a path, in cube units: the closest hit so far.
float maxDistance(uint path) { return uintBitsToFloat(loadHit(path).x) * cubeScale(); }

// Stores a hit nearer than the one so far, with t in render units, and appends the path to the hit list for surface.
void storeHit(bool live, uint path, TraceHit hit) {
    bool hits = live && hit.disc != NO_INDEX;
    if (hits)
        imageStore(hit_texels, int(path),
                   uvec4(floatBitsToUint(hit.t / cubeScale()), hit.cell, hit.disc, instance.materials.x));
    appendEntry(APPEND_HIT, hits, path);
}

#endif

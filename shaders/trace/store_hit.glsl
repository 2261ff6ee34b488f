// SPDX-License-Identifier: Apache-2.0
// Between the rays of paths and the hits that are kept of them.
#ifndef POINTRT_SHADERS_STORE_HIT_GLSL
#define POINTRT_SHADERS_STORE_HIT_GLSL

// How far a path's ray may go, in cube units: to what was hit before.
float reachOf(uint path) { return uintBitsToFloat(loadHit(path).x) * cubeScale(); }

// t is stored in render units. What was hit before, and nearer, stays. Other hits are listed for surface.
void storeHit(bool live, uint path, TraceHit hit) {
    bool hits = live && hit.disc != NO_INDEX;
    if (hits)
        imageStore(hit_texels, int(path),
                   uvec4(floatBitsToUint(hit.t / cubeScale()), hit.cell, hit.disc, instance.materials.x));
    appendEntry(APPEND_HIT, hits, path);
}

#endif

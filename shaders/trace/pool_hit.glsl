// SPDX-License-Identifier: Apache-2.0
// The closest hit of a ray on the tiles of a block. Tiles are tested in order, as if each had a dispatch of its own, so
// pictures are the same to the bit.
#ifndef POINTRT_SHADERS_POOL_HIT_GLSL
#define POINTRT_SHADERS_POOL_HIT_GLSL

// The closest hit so far, encoded as in hit_texels.
struct PooledHit {
    uvec4 words;
    bool found; // in one of these tiles
};

// t_max of the ray in the cube of the selected tile.
float maxDistance(PooledHit closest) { return uintBitsToFloat(closest.words.x) * cubeScale(); }

// Takes a hit in the selected tile if there is one. Counts it as dispatches for each tile would: a nearer hit in a later
// tile does not take it back.
void takeHit(uint place, TraceHit hit, inout PooledHit closest) {
    bool hits = hit.disc != NO_INDEX;
    uvec4 words = storedHit(hit) | uvec4(0u, 0u, 0u, place << HIT_PLACE_SHIFT);
    closest.words = hits ? words : closest.words;
    closest.found = closest.found || hits;
    if (hits && hasStep(STEP_COUNT_HITS)) atomicAdd(control.lists[LIST_CULLED + place].hits, 1u);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// The closest hit of a ray on the tiles of a block. Tiles are tested in order, as if each had its own dispatch, so
// pictures are bit-identical.
#ifndef POINTRT_SHADERS_POOL_HIT_GLSL
#define POINTRT_SHADERS_POOL_HIT_GLSL

// A copy of the closest stored hit of a path so far.
struct ClosestHit {
    float t;    // render units
    bool found; // whether it is on one of these tiles
};

ClosestHit closestBefore(uint path) { return ClosestHit(uintBitsToFloat(loadHit(path).x), false); }

// The first tile in a mask, as a place among the tiles of the program.
uint firstTile(uint tiles) { return uint(findLSB(tiles)); }

// Stores the hit in the first tile of the mask, if any. Counts hits as a separate dispatch for each tile would: nearer
// hits in later tiles do not undo the count.
void takeHit(uint path, uint tiles, TraceHit hit, inout ClosestHit closest) {
    if (hit.disc == NO_INDEX) return;
    uint place = again(firstTile(tiles));
    selectTile(place);
    uvec4 words = storedHit(hit) | uvec4(0u, 0u, 0u, place << HIT_PLACE_SHIFT);
    imageStore(hit_texels, int(path), words);
    closest = ClosestHit(uintBitsToFloat(words.x), true);
    if (hasStep(STEP_COUNT_HITS)) atomicAdd(control.lists[LIST_CULLED + place].hits, 1u);
}

#endif

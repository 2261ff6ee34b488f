// SPDX-License-Identifier: Apache-2.0
// Decoding of the list of a cell.
#ifndef POINTRT_SHADERS_CELL_LIST_GLSL
#define POINTRT_SHADERS_CELL_LIST_GLSL

// Offset from the centre of a cell to the centre of its near splats, in half edges of the cell.
vec3 middleOffset(uint word) {
    const int top = 32 - PRO_CELL_OFFSET_SHIFT - PRO_CELL_OFFSET_BITS;
    return vec3(ivec3(int(word)) << (top - PRO_CELL_OFFSET_BITS * ivec3(0, 1, 2)) >> (32 - PRO_CELL_OFFSET_BITS));
}

// The near splats of entries i and i + 1 (i even) of the list of splats that only blend in a cell. first: first near
// splat of the cell.
uvec2 blendingPair(uint i, uint first) {
    int numbers = int(loadBlending(i >> 1));
    return uvec2(int(first) + (ivec2(numbers << 16, numbers) >> 16));
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Which leaf and which cell of its brick hold a position: the grid of entry points stands for the octree's upper levels,
// nodes for the rest.
#ifndef POINTRT_SHADERS_OCTREE_GLSL
#define POINTRT_SHADERS_OCTREE_GLSL

int gridShift() { return int(params.grid.x); }

// The grid's lowest position and the one behind its last.
ivec3 gridBegin() { return ivec3(params.grid_origin.xyz) << gridShift(); }
ivec3 gridEnd() { return ivec3(params.grid_origin.xyz + params.grid_size.xyz) << gridShift(); }

bool inGrid(ivec3 position) {
    return all(greaterThanEqual(position, gridBegin())) && all(lessThan(position, gridEnd()));
}

uint gridWord(ivec3 cell) {
    uvec3 at = uvec3(cell) - params.grid_origin.xyz;
    return loadGrid((at.z * params.grid_size.y + at.y) * params.grid_size.x + at.x);
}

bool isFilled(uint grid_word) { return (grid_word & GRID_EMPTY_MASK) == 0u; }

// From a filled grid cell down to the leaf that holds the position; shift receives the log2 of its edge, where that is
// less than the grid's. Returns the leaf's index, NO_INDEX where it is empty.
uint findLeaf(uint grid_word, ivec3 position, inout int shift) {
    if ((grid_word & GRID_LEAF) != 0u) return grid_word >> GRID_INDEX_SHIFT;
    uint node = PRO_NODE_INNER | grid_word >> GRID_INDEX_SHIFT;
    while ((node & PRO_NODE_INNER) != 0u && shift > 0) {
        shift--;
        ivec3 bits = (position >> shift) & 1;
        node = loadNode((node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + uint(bits.x | bits.y << 1 | bits.z << 2));
    }
    return node - 1u; // an empty leaf becomes NO_INDEX
}

// A brick's place: lowest corner and edge of its leaf, in cube units.
vec4 brickPlace(uvec4 brick, ivec3 position) {
    int shift = int(brick[BRICK_SHIFT]);
    return vec4(vec3((position >> shift) << shift), float(1 << shift)) * PRO_POSITION_STEP;
}

// The cell of the brick that holds a point, which may have no list.
ivec3 brickCell(vec4 place, vec3 point) {
    return clamp(ivec3((point - place.xyz) * (float(BRICK_SIDE) / place.w)), ivec3(0), ivec3(BRICK_SIDE - 1));
}

// Number of a brick's cell in the cells, NO_INDEX where it has no list.
uint listedCell(uvec4 brick, ivec3 cell) {
    uint bit = uint(cell.x + BRICK_SIDE * (cell.y + BRICK_SIDE * cell.z));
    bool listed = (brick[BRICK_MASK] >> bit & 1u) != 0u;
    return listed ? brick[BRICK_FIRST_CELL] + bitCount(brick[BRICK_MASK] & ((1u << bit) - 1u)) : NO_INDEX;
}

// The listed cell that holds a point, NO_INDEX where there is none.
uint cellAt(vec3 point) {
    ivec3 position = ivec3(floor(point * PRO_POSITION_STEPS));
    if (!inGrid(position)) return NO_INDEX;
    int shift = gridShift();
    uint word = gridWord(position >> shift);
    uint leaf = isFilled(word) ? findLeaf(word, position, shift) : NO_INDEX;
    if (leaf == NO_INDEX) return NO_INDEX;
    uvec4 brick = loadBrick(leaf);
    return listedCell(brick, brickCell(brickPlace(brick, position), point));
}

#endif

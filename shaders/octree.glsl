// SPDX-License-Identifier: Apache-2.0
// Which leaf holds a position: the grid of entry points stands for the upper levels, nodes for the rest.
#ifndef POINTRT_SHADERS_OCTREE_GLSL
#define POINTRT_SHADERS_OCTREE_GLSL

const int kFullDepth = int(PRO_POSITION_BITS);
const int kLastCell = int(PRO_POSITION_MASK);

uint gridWord(ivec3 cell) {
    int grid_bits = int(params.grid.x);
    return loadGrid(((cell.z << grid_bits) | cell.y) << grid_bits | cell.x);
}

bool isFilled(uint grid_word) { return (grid_word & 15u) == 0u; }

// From a filled grid cell down to the leaf that holds the position; shift receives the log2 of its edge.
// Returns the leaf's index, NO_INDEX where it is empty.
uint findLeaf(uint grid_word, ivec3 position, inout int shift) {
    uint node = loadNode(grid_word >> 4);
    while ((node & PRO_NODE_INNER) != 0u && shift > 0) {
        shift--;
        ivec3 bits = (position >> shift) & 1;
        node = loadNode((node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + uint(bits.x | bits.y << 1 | bits.z << 2));
    }
    return node - 1u; // an empty leaf becomes NO_INDEX
}

// The leaf that holds a point, NO_INDEX where there is none.
uint leafAt(vec3 point) {
    ivec3 position = clamp(ivec3(point * PRO_POSITION_STEPS), ivec3(0), ivec3(kLastCell));
    int shift = kFullDepth - int(params.grid.x);
    uint word = gridWord(position >> shift);
    return isFilled(word) ? findLeaf(word, position, shift) : NO_INDEX;
}

#endif

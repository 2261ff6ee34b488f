// SPDX-License-Identifier: Apache-2.0
// Which cell holds a point: the grid of entry points stands for the octree's upper levels, a brick of 4 x 4 x 4 cells
// for the next ones, groups of 8 for what is deeper. All in grid cells ("grid units") from the grid's lowest corner.
#ifndef POINTRT_SHADERS_OCTREE_GLSL
#define POINTRT_SHADERS_OCTREE_GLSL

#include "shaders/trace/instance.glsl"

// What every step needs of the frame, loaded once.
struct Grid {
    uint row; // words
    uint layer;
    uint last_word;
    uint last_brick_word;
};

Grid loadGridFrame() {
    uvec4 words = instance.grid_words;
    return Grid(instance.grid_size.x, words.x, words.y, words.z);
}

// Of a point in cube units.
vec3 gridPoint(vec3 cube) { return cube * instance.grid_scale.x - vec3(instance.grid_origin.xyz); }

// The grid's highest corner.
vec3 gridEnd() { return vec3(instance.grid_size.xyz); }

// Of what a ray is from a tile, rounding makes less than this: a few times 2^-24.
const float kCoreRounding = 4e-7;

// What of the grid is to be walked through by rays that start here (grid units): all of it, of a tile its core, and
// around that what rounding takes, which is another for each tile: the ray must not pass between two of them.
void walkedBox(vec3 origin, out vec3 lowest, out vec3 highest) {
    lowest = vec3(0.0);
    highest = gridEnd();
    if (kCored) {
        vec3 away = abs(origin);
        float margin = instance.core_low.w + kCoreRounding * max(away.x, max(away.y, away.z));
        lowest = max(instance.core_low.xyz - margin, lowest);
        highest = min(instance.core_high.xyz + margin, highest);
    }
}

// Cells to skip from an empty one towards the octant that shift stands for. No product, no conversion: what follows a
// load is what a step takes.
float skippedCells(uint word, uint octant_shift) {
    uint code = word >> octant_shift & PRO_SKIP_MASK;
    float cells = uintBitsToFloat((code << PRO_SKIP_SHIFT) + PRO_SKIP_BIAS);
    return code == PRO_SKIP_MASK ? PRO_SKIP_FARTHEST : cells;
}

bool isFilled(uint word) { return (word & PRO_SKIP_MASK) == 0u; }

// Where a point is: in a listed cell, or in an empty one of which some more follow in each direction.
struct Spot {
    vec3 base;    // lowest corner of the cell, in its edges
    float edge;   // of the cell
    uint word;    // of the cell, or of the grid cell where all of that is empty
};

// Deeper than a brick: the group's word that holds the point.
void descend(vec3 point, inout Spot spot) {
    // lavapipe runs a loop's body once more for lanes that have left it: what is kept must be selected
    do {
        bool inner = (spot.word & (PRO_SKIP_MASK | PRO_CELL_INNER)) == PRO_CELL_INNER;
        vec3 half_base = min(max(floor(point / (0.5 * spot.edge)), 2.0 * spot.base), 2.0 * spot.base + 1.0);
        vec3 bits = half_base - 2.0 * spot.base;
        uint slot = uint(int(bits.x + 2.0 * bits.y + 4.0 * bits.z));
        uint word = loadBrickWord(inner ? (spot.word >> PRO_CELL_INDEX_SHIFT) * PRO_GROUP_WORDS + slot : 0u);
        spot.base = inner ? half_base : spot.base;
        spot.edge = inner ? 0.5 * spot.edge : spot.edge;
        spot.word = inner ? word : spot.word;
    } while ((spot.word & (PRO_SKIP_MASK | PRO_CELL_INNER)) == PRO_CELL_INNER);
}

// Of the grid cell with this lowest corner; from outside, of whatever cell.
uint gridWord(ivec3 base, Grid grid) {
    uvec3 at = uvec3(base);
    return loadGrid(min(at.x + at.y * grid.row + at.z * grid.layer, grid.last_word));
}

// A brick's first word from the grid word that names it.
uint firstWord(uint grid_word) { return (grid_word >> PRO_GRID_BRICK_SHIFT) * PRO_BRICK_WORDS; }

// Points outside the grid get an answer too, of whatever cell.
Spot spotAt(vec3 point, Grid grid) {
    ivec3 grid_base = ivec3(point), brick_base = ivec3(point * float(PRO_BRICK_SIDE));
    uint grid_word = gridWord(grid_base, grid);
    bool filled = isFilled(grid_word);
    uvec3 part = uvec3(brick_base) & (PRO_BRICK_SIDE - 1u);
    uint cell = part.x | part.y << PRO_BRICK_BITS | part.z << 2u * PRO_BRICK_BITS;
    // an empty word names no brick: any one's word will do
    uint brick_word = loadBrickWord(min(firstWord(grid_word) | cell, grid.last_brick_word));
    Spot spot = Spot(vec3(filled ? brick_base : grid_base), filled ? 1.0 / float(PRO_BRICK_SIDE) : 1.0,
                     filled ? brick_word : grid_word);
    if (kUneven) descend(point, spot);
    return spot;
}

// The listed cell that holds a point in cube units, NO_INDEX where there is none.
uint cellAt(vec3 point) {
    vec3 at = gridPoint(point);
    Spot spot = spotAt(at, loadGridFrame());
    bool inside = all(greaterThanEqual(at, vec3(0.0))) && all(lessThan(at, gridEnd()));
    return inside && isFilled(spot.word) ? spot.word >> PRO_CELL_INDEX_SHIFT : NO_INDEX;
}

#endif

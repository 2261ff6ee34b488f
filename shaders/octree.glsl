// SPDX-License-Identifier: Apache-2.0
// Which cell holds a point: the grid of entry points stands for the octree's upper levels, a brick of 4 x 4 x 4 cells
// for the next ones, groups of 8 for what is deeper. All in grid cells ("grid units") from the grid's lowest corner.
#ifndef POINTRT_SHADERS_OCTREE_GLSL
#define POINTRT_SHADERS_OCTREE_GLSL

#include "instance.glsl"

// What every step needs of the frame, loaded once.
struct Grid {
    vec2 stride;    // words in a row and in a layer
    uint last_word;
};

Grid loadGridFrame() { return Grid(instance.grid_scale.yz, instance.grid_size.w); }

// Of a point in cube units.
vec3 gridPoint(vec3 cube) { return cube * instance.grid_scale.x - vec3(instance.grid_origin.xyz); }

// The grid's highest corner.
vec3 gridEnd() { return vec3(instance.grid_size.xyz); }

// Cells to skip from an empty one towards the octant that shift stands for.
float skippedCells(uint word, uint octant_shift) {
    float code = float(int(word >> octant_shift & PRO_SKIP_MASK));
    return max(code, PRO_SKIP_SQUARE * code * code);
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
uint gridWord(vec3 base, Grid grid) {
    int index = int(base.x + base.y * grid.stride.x + base.z * grid.stride.y);
    return loadGrid(min(uint(index), grid.last_word));
}

// Points outside the grid get an answer too, of whatever cell.
Spot spotAt(vec3 point, Grid grid) {
    vec3 grid_base = floor(point);
    uint grid_word = gridWord(grid_base, grid);
    bool filled = isFilled(grid_word);
    vec3 part = floor((point - grid_base) * float(PRO_BRICK_SIDE));
    uint cell = uint(int(part.x + part.y * float(PRO_BRICK_SIDE) + part.z * float(PRO_BRICK_SIDE * PRO_BRICK_SIDE)));
    cell = min(cell, PRO_BRICK_WORDS - 1u); // rounding from below 0, or no number
    uint brick_word = loadBrickWord(filled ? (grid_word >> PRO_GRID_BRICK_SHIFT) * PRO_BRICK_WORDS + cell : 0u);
    vec3 brick_base = grid_base * float(PRO_BRICK_SIDE) + part;
    Spot spot = Spot(filled ? brick_base : grid_base, filled ? 1.0 / float(PRO_BRICK_SIDE) : 1.0,
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

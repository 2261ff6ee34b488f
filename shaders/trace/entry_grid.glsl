// SPDX-License-Identifier: Apache-2.0
// Point location: finds the cell that holds a point. The entry grid replaces the upper levels of the octree, a brick of
// 4 x 4 x 4 cells the next ones, groups of 8 the deeper ones. Positions are in grid cells ("grid units") from the
// lowest corner of the grid.
#ifndef POINTRT_SHADERS_OCTREE_GLSL
#define POINTRT_SHADERS_OCTREE_GLSL

#include "shaders/trace/instance.glsl"

// Parameters of the grid that every step needs, loaded once.
struct Grid {
    uint row;   // words per row
    uint layer; // words per layer
    uint last_word;
    uint last_brick_word;
};

Grid loadGridFrame() {
    uvec4 words = instance.grid_words;
    return Grid(instance.grid_size.x, words.x, words.y, words.z);
}

// Cube units to grid units.
vec3 gridPoint(vec3 cube) { return cube * instance.grid_scale.x - vec3(instance.grid_origin.xyz); }

// The grid's highest corner.
vec3 gridEnd() { return vec3(instance.grid_size.xyz); }

// Bound of the rounding error, relative to the distance of a ray's origin from a tile: a few times 2^-24.
const float kCoreRounding = 4e-7;

// The part of the grid that rays from this origin (grid units) traverse: all of the grid, or the core of a tile with a
// margin. Rounding differs between tiles, and without the margin a ray might slip between two of them.
void traversedBox(vec3 origin, out vec3 lowest, out vec3 highest) {
    lowest = vec3(0.0);
    highest = gridEnd();
    if (kClipsToCore) {
        vec3 away = abs(origin);
        float margin = instance.core_low.w + kCoreRounding * max(away.x, max(away.y, away.z));
        lowest = max(instance.core_low.xyz - margin, lowest);
        highest = min(instance.core_high.xyz + margin, highest);
    }
}

// Number of cells to skip from an empty cell in the direction octant given by the shift. Uses no multiplication or
// conversion, since the latency after the load dominates a step.
float skippedCells(uint word, uint octant_shift) {
    uint code = word >> octant_shift & PRO_SKIP_MASK;
    float cells = uintBitsToFloat((code << PRO_SKIP_SHIFT) + PRO_SKIP_BIAS);
    return code == PRO_SKIP_MASK ? PRO_SKIP_FARTHEST : cells;
}

bool isFilled(uint word) { return (word & PRO_SKIP_MASK) == 0u; }

// The cell that holds a point: a filled one, or an empty one with skips in each direction.
struct Spot {
    vec3 base;    // lowest corner of the cell, in units of its edge
    float edge;   // of the cell
    uint word;    // of the cell, or of the grid cell if the whole grid cell is empty
};

// Descends from a brick cell through groups to the cell that holds the point.
void descend(vec3 point, inout Spot spot) {
    // lavapipe runs the loop body once more for lanes that have left it: results must be selected
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

// The word of the grid cell with this lowest corner; outside the grid, that of an arbitrary cell.
uint gridWord(ivec3 base, Grid grid) {
    uvec3 at = uvec3(base);
    return loadGrid(min(at.x + at.y * grid.row + at.z * grid.layer, grid.last_word));
}

// Index of the first word of the brick that a grid word refers to.
uint firstWord(uint grid_word) { return (grid_word >> PRO_GRID_BRICK_SHIFT) * PRO_BRICK_WORDS; }

// Outside the grid, the result is that of an arbitrary cell.
Spot spotAt(vec3 point, Grid grid) {
    ivec3 grid_base = ivec3(point), brick_base = ivec3(point * float(PRO_BRICK_SIDE));
    uint grid_word = gridWord(grid_base, grid);
    bool filled = isFilled(grid_word);
    uvec3 part = uvec3(brick_base) & (PRO_BRICK_SIDE - 1u);
    uint cell = part.x | part.y << PRO_BRICK_BITS | part.z << 2u * PRO_BRICK_BITS;
    // an empty grid word refers to no brick: any brick word will do
    uint brick_word = loadBrickWord(min(firstWord(grid_word) | cell, grid.last_brick_word));
    Spot spot = Spot(vec3(filled ? brick_base : grid_base), filled ? 1.0 / float(PRO_BRICK_SIDE) : 1.0,
                     filled ? brick_word : grid_word);
    if (kUneven) descend(point, spot);
    return spot;
}

// The filled cell that holds a point in cube units; NO_INDEX if the point is outside or in an empty cell.
uint cellAt(vec3 point) {
    vec3 at = gridPoint(point);
    Spot spot = spotAt(at, loadGridFrame());
    bool inside = all(greaterThanEqual(at, vec3(0.0))) && all(lessThan(at, gridEnd()));
    return inside && isFilled(spot.word) ? spot.word >> PRO_CELL_INDEX_SHIFT : NO_INDEX;
}

#endif

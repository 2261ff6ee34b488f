// SPDX-License-Identifier: Apache-2.0
// Bricks and the entry grid: what the viewer makes of the octree of a .pro. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_BRICK_LAYOUT_H
#define POINTRT_SHADERS_BRICK_LAYOUT_H

// Cells along an edge of a leaf. A leaf is about 8 radii wide; of the sizes tried, cells of 8/3 radii trace fastest.
#define BRICK_SIDE 3
#define BRICK_CELLS 27

// A brick: one uvec4.
#define BRICK_WORDS 4u
#define BRICK_MASK 0u       // bit x + 3 y + 9 z: the cell has a list
#define BRICK_FIRST_CELL 1u // the lists' cells follow one another in the order of the bits
#define BRICK_SHIFT 2u      // log2 of the leaf's edge in position steps

// A cell: one uvec4.
#define CELL_WORDS 4u
#define CELL_FIRST 0u  // in the lists
#define CELL_COUNTS 1u // splats whose discs cross the cell in the low half, those that only blend in the high half
#define CELL_NORMAL 2u // mean normal of the discs that cross it, 3 times 10 bits: code / 511 - 1
#define CELL_SLAB 3u   // two halves: least and greatest height along it, in cell edges from the cell's centre
#define CELL_COUNT_MASK 0xFFFFu
#define CELL_COUNT_SHIFT 16u
#define CELL_NORMAL_BITS 10u
#define CELL_NORMAL_MASK 0x3FFu
#define CELL_NORMAL_ZERO 511.0f

// A word of the entry grid (runtime/entry_grid.h).
#define GRID_EMPTY_MASK 15u // 0 in these bits marks a filled cell
#define GRID_LEAF 16u
#define GRID_INDEX_SHIFT 5u

#endif

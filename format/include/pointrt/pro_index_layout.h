// SPDX-License-Identifier: Apache-2.0
// The tracing index: the entry grid, its bricks and their cells, built from the octree by format/index and stored in
// optional sections of a .pro. Valid in C99, C++ and GLSL.
#ifndef POINTRT_PRO_INDEX_LAYOUT_H
#define POINTRT_PRO_INDEX_LAYOUT_H

// A word of the entry grid or of a brick is empty or filled. Nibble k of an empty word is a code, 1 to 15, for the size
// of an empty cube that has the cell in its corner and extends towards octant k (bit 0 of k: increasing x, bit 1: y,
// bit 2: z). The size in cell edges is PRO_SKIP_FARTHEST for code 15, else the float with the bits
// (code << PRO_SKIP_SHIFT) + PRO_SKIP_BIAS: 1, 1.25, 1.5, 1.75, 2, 2.5 and so on, with 3 bits of precision, up to 10.
// So the cubes of a grid word may end inside a brick, at a border of its cells. The low nibble of a filled word is 0.
#define PRO_SKIP_BITS 4u
#define PRO_SKIP_MASK 15u
#define PRO_SKIP_SHIFT 21u
#define PRO_SKIP_BIAS 0x3F600000u
#define PRO_SKIP_FARTHEST 28.0f

// A filled grid word names its brick: brick << PRO_GRID_BRICK_SHIFT.
#define PRO_GRID_BRICK_SHIFT 4u

// A brick: the words of 4 x 4 x 4 cells, x fastest. After all bricks come groups of 8 words for cells with too many
// splats. A filled word names a cell, or with PRO_CELL_INNER the group of its halves: index << PRO_CELL_INDEX_SHIFT.
#define PRO_BRICK_SIDE 4
#define PRO_BRICK_BITS 2u // log2 of PRO_BRICK_SIDE
#define PRO_BRICK_WORDS 64u
#define PRO_GROUP_WORDS 8u
#define PRO_CELL_INNER 16u
#define PRO_CELL_INDEX_SHIFT 5u

// A cell: the run of near splats whose discs cross it, and the splats that only blend there, as signed 16-bit offsets
// from the first near splat of the run, two per word from the low half up.
#define PRO_CELL_WORDS 4u
#define PRO_CELL_FIRST 0u // near splat
#define PRO_CELL_COUNT 1u // near splats in the low half; position codes per edge in the high half, as a half float
#define PRO_CELL_COUNT_MASK 0xFFFFu
#define PRO_CELL_CODES_SHIFT 16u
#define PRO_CELL_BLENDING 2u       // the first of these offsets in BLDS, even
#define PRO_CELL_BLENDING_COUNT 3u // their count in the low half; the offset to the origin in the high half
#define PRO_CELL_BLENDING_MASK 0xFFFFu
#define PRO_CELL_LISTED_MAX 0x7FFF // splats that a cell lists

// The offset from the centre of the cell to the origin of its near splats' positions, in half edges of the cell: signed
// codes x, y, z from this bit on.
#define PRO_CELL_OFFSET_SHIFT 16
#define PRO_CELL_OFFSET_BITS 5
#define PRO_CELL_OFFSET_MAX 15

// A word with two planes that enclose the parts of discs in a cell. From the low bits up: their normal x, y, z as
// signed codes of 6 bits, then the smallest and the largest height along it from the cell's centre as signed codes of 7
// bits, PRO_SLAB_STEPS per edge if the codes of the normal are divided by PRO_SLAB_NORMAL_MAX.
#define PRO_SLAB_NORMAL_BITS 6
#define PRO_SLAB_NORMAL_MAX 31
#define PRO_SLAB_HEIGHT_BITS 7
#define PRO_SLAB_HEIGHT_MAX 63
#define PRO_SLAB_STEPS 63.0f

// A near splat: a disc for ray tests, two per texel, next to those of neighbouring cells. From the high bits down, word
// 0: position x, y, z as signed codes relative to an origin that these cells share, then the high bits of the radius
// code; word 1: normal x, y, z as signed codes, the largest of them 127 or -127, then the low bits of the radius code.
// The radius code is the upper bits of a float, from an exponent of -13 on: the squared radius in position codes. A
// normal of 0 marks a ball or, if the radius code is 0 too, an unused entry.
#define PRO_NEAR_WORDS 2u
#define PRO_NEAR_POSITION_BITS 10
#define PRO_NEAR_POSITION_MAX 511
#define PRO_NEAR_NORMAL_BITS 8
#define PRO_NEAR_NORMAL_MAX 127
#define PRO_NEAR_RADIUS_LOW_BITS 8u
#define PRO_NEAR_RADIUS_LOW_MASK 0xFFu
#define PRO_NEAR_RADIUS_HIGH_BITS 2u
#define PRO_NEAR_RADIUS_HIGH_MASK 3u
#define PRO_NEAR_RADIUS_SHIFT 18u
#define PRO_NEAR_RADIUS_BIAS 0x39000000u

#endif

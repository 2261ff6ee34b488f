// SPDX-License-Identifier: Apache-2.0
// The pixels that a frame considers: one row in ROW_PHASES.
#ifndef POINTRT_SHADERS_CONSIDERED_GLSL
#define POINTRT_SHADERS_CONSIDERED_GLSL
#include "shaders/display/point_cache.glsl"

uint consideredOfRow() { return params.tiles_across * CONSIDERED_OF_TILE; }

// The i-th of a row of tiles, tile by tile.
uvec2 consideredPlace(uint tile_row, uint i) {
    // consecutive phases never consider adjacent rows
    uint phase = params.frame * 2u % ROW_PHASES + params.frame / 2u % 2u;
    uint of_tile = i % CONSIDERED_OF_TILE;
    return uvec2(i / CONSIDERED_OF_TILE, tile_row) * TILE_SIDE +
           uvec2(of_tile % TILE_SIDE, phase + of_tile / TILE_SIDE * ROW_PHASES);
}

#endif

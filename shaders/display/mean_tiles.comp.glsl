// SPDX-License-Identifier: Apache-2.0
// Mean colours of tiles, over the smallest neighbourhood of tiles that has any colours. A lane for each tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

const uint kWidest = 4u;

void main() {
    if (lane() >= params.tiles_across * params.tiles_down) return;
    uvec2 tile = tilePlace(lane()), last = uvec2(params.tiles_across, params.tiles_down) - 1u;
    uint mean = kBlack;
    for (uint reach = 0u; reach <= kWidest && mean == kBlack; ++reach) {
        uvec4 sum = uvec4(0);
        for (uint y = tile.y - min(tile.y, reach); y <= min(tile.y + reach, last.y); ++y)
            for (uint x = tile.x - min(tile.x, reach); x <= min(tile.x + reach, last.x); ++x) {
                TileColors colors = tiles[y * params.tiles_across + x];
                sum += uvec4(colors.red, colors.green, colors.blue, colors.count);
            }
        if (sum.w > 0u) mean = packColor(sum.rgb / sum.w);
        if (sum.w > 0u) break;
    }
    tile_means[lane()] = mean;
}

// SPDX-License-Identifier: Apache-2.0
// Gives each empty pixel a colour: the mean of its farthest neighbours, since disocclusions reveal background. Gaps
// within one surface get that surface's colour, and pixels far from all points the mean of the surrounding tiles. The
// pixels still count as empty. A lane for each pixel, by tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/display/neighbors.glsl"

// Distances in pixels at which to look for background around a hole: in one frame, a disocclusion seldom becomes wider
// than twice the larger one. If a tile has points in fewer than an eighth of its pixels, its holes get the mean colours
// of tiles instead, since neighbours are rare.
const uint kFarRings[2] = uint[](3u, 7u);
const uint kMinPointsInTile = TILE_PIXELS / 8u;

// Bilinear interpolation between the centres of the four nearest tiles.
uint tileMean(uvec2 place) {
    vec2 last = vec2(params.tiles_across - 1u, params.tiles_down - 1u);
    vec2 at = clamp((vec2(place) + 0.5) / float(TILE_SIDE) - 0.5, vec2(0.0), last);
    uvec2 low = uvec2(at), high = min(low + 1u, uvec2(last)), share = uvec2(256.0 * (at - vec2(low)));
    uint above = low.y * params.tiles_across, below = high.y * params.tiles_across;
    return mixColors(mixColors(tile_means[above + low.x], tile_means[above + high.x], share.x),
                     mixColors(tile_means[below + low.x], tile_means[below + high.x], share.x), share.y);
}

uint fillColor(uvec2 place, out bool is_gap) {
    is_gap = false;
    if (tiles[tileAt(place)].count < kMinPointsInTile) return tileMean(place);
    Neighbors found = noNeighbors();
    addRing(found, place, 1u);
    is_gap = isContinuous(found);
    if (!is_gap)
        for (int i = 0; i < 2; ++i) addRing(found, place, kFarRings[i]);
    return found.count > 0u ? packColor(found.color / found.count) : tileMean(place);
}

void main() {
    bool is_inside = isLaneInPicture(), is_gap = false;
    uvec2 place = is_inside ? laneInTile() : uvec2(0);
    if (is_inside && !hasPoint(pixelAt(place))) shown[pixelAt(place)] = fillColor(place, is_gap);
    uint gaps = subgroupAdd(is_gap ? 1u : 0u);
    if (subgroupElect() && gaps > 0u) atomicAdd(control.gaps, gaps);
}

// SPDX-License-Identifier: Apache-2.0
// Lists the pixels to trace, with probabilities proportional to their priorities; neighbours together. A lane for each
// considered pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/display/considered.glsl"

// Thresholds in (0, 1], evenly distributed over the picture and, for each pixel, over the frames: the R2 and golden
// ratio sequences (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018), in units of 2^-32.
float threshold(uvec2 place) {
    uint at = place.x * 0xC13FA9A9u + place.y * 0x91E10DA6u + params.frame * 0x9E3779B9u;
    return (float(at >> 8) + 1.0) * (1.0 / 16777216.0);
}

void main() {
    uint tile_row = lane() / consideredOfRow(), i = lane() % consideredOfRow();
    uvec2 place = consideredPlace(tile_row, i);
    bool is_selected = tile_row < params.tiles_down && isInPicture(place) &&
                       priorities[min(lane(), params.tiles_down * consideredOfRow() - 1u)] * control.probability >= threshold(place);
    uvec4 ballot = subgroupBallot(is_selected);
    uint total = subgroupBallotBitCount(ballot), start = 0u;
    if (subgroupElect() && total > 0u) start = atomicAdd(control.selected, total);
    uint slot = subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
    if (is_selected && slot < params.listed) pixel_list[slot] = place.x | place.y << 16;
}

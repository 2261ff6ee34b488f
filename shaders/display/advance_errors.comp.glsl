// SPDX-License-Identifier: Apache-2.0
// Begins a frame: the errors of tiles decay and spread to their neighbours, since shadow edges move. A lane per tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

// Share of an error that remains a frame later, and that neighbouring tiles get.
const float kErrorDecay = 0.85, kErrorSpread = 0.5;
// Smaller differences, in steps of 255, are not errors but rounding and noise of soft light.
const uint kNoiseFloor = 3u;

uint recordedAt(ivec2 tile) {
    bool is_inside = all(lessThan(uvec2(tile), uvec2(params.tiles_across, params.tiles_down)));
    uint steps = is_inside ? recorded[tile.y * int(params.tiles_across) + tile.x] : 0u;
    return steps > kNoiseFloor ? steps : 0u;
}

void main() {
    if (lane() == 0u) {
        control.point_count = pointCount();
        control.selected = control.gaps = control.is_balanced = 0u;
        control.probability = 0.0;
    }
    if (lane() >= params.tiles_across * params.tiles_down) return;
    ivec2 at = ivec2(tilePlace(lane()));
    uint adjacent = max(max(recordedAt(at - ivec2(1, 0)), recordedAt(at + ivec2(1, 0))),
                        max(recordedAt(at - ivec2(0, 1)), recordedAt(at + ivec2(0, 1))));
    float error = max(max(kErrorDecay * errors[lane()], float(recordedAt(at))), kErrorSpread * float(adjacent));
    errors[lane()] = error < float(kNoiseFloor) ? 0.0 : error;
}

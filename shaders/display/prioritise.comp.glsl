// SPDX-License-Identifier: Apache-2.0
// Computes how soon the considered pixels should be traced: disoccluded, wrong or old ones first, and those near the
// attention point. A workgroup for each row of tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/considered.glsl"
#include "shaders/display/group_sum.glsl"

// Priorities in frames of age, for empty pixels; for interpolated points, and empty pixels with only sky around; and
// for points near an error of a full step from black to white. While the camera moves, view-dependent points age this
// much faster.
const float kEmptyPriority = 1500.0, kInterpolatedPriority = 150.0, kErrorPriority = 3000.0, kViewDependentAging = 8.0;
// Gain at the attention point, and its radius as a fraction of the picture's height.
const float kFocusGain = 2.0, kFocusRadius = 0.2;

// Whether this tile and its neighbours have points, and only points of the sky.
bool isSky(uvec2 tile) {
    uvec2 last = uvec2(params.tiles_across, params.tiles_down) - 1u;
    for (uint y = tile.y - min(tile.y, 1u); y <= min(tile.y + 1u, last.y); ++y)
        for (uint x = tile.x - min(tile.x, 1u); x <= min(tile.x + 1u, last.x); ++x) {
            TileColors around = tiles[y * params.tiles_across + x];
            if (around.count == 0u || around.surfaces > 0u) return false;
        }
    return true;
}

float pointPriority(uint info) {
    float age = float((params.frame - info) & POINT_FRAME_MASK);
    bool ages_faster = params.camera_moves != 0u && (info & POINT_VIEW_DEPENDENT) != 0u;
    return age * (ages_faster ? kViewDependentAging : 1.0) +
           ((info & POINT_INTERPOLATED) != 0u ? kInterpolatedPriority : 0.0);
}

float priorityOf(uvec2 place) {
    uvec2 tile = place / TILE_SIDE;
    uint point = seen[pixelAt(place)];
    float own = point != NO_INDEX ? pointPriority(infoOf(point)) : isSky(tile) ? kInterpolatedPriority : kEmptyPriority;
    vec2 offset = (vec2(tile) + 0.5) * float(TILE_SIDE) - vec2(params.focus_x, params.focus_y);
    float radius = kFocusRadius * float(params.height);
    float factor = 1.0 + kFocusGain / (1.0 + dot(offset, offset) / (radius * radius));
    return (own + kErrorPriority / 255.0 * errors[tileAt(place)]) * factor;
}

void main() {
    uint tile_row = gl_WorkGroupID.x, row = tile_row * consideredOfRow();
    float sum = 0.0;
    for (uint i = gl_LocalInvocationID.x; i < consideredOfRow(); i += REPROJECT_GROUP) {
        uvec2 place = consideredPlace(tile_row, i);
        float priority = isInPicture(place) ? priorityOf(place) : 0.0;
        priorities[row + i] = priority;
        sum += priority;
    }
    for (uint x = gl_LocalInvocationID.x; x < params.tiles_across; x += REPROJECT_GROUP)
        // clears it for this frame: advance_errors has read the errors of the last frame
        recorded[tile_row * params.tiles_across + x] = 0u;
    float total = groupSum(vec2(sum, 0.0)).x;
    if (gl_LocalInvocationID.x == 0u) row_sums[tile_row] = RowSum(total, 0.0);
}

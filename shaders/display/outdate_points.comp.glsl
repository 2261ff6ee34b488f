// SPDX-License-Identifier: Apache-2.0
// Marks all colours as old after lights, materials or shapes have changed. A lane for each place in the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

// Points traced before the light changed count as at least this many frames old.
const uint kStaleLightAge = 64u;

void main() {
    if (lane() >= pointCount()) return;
    uint info = infoOf(lane()), age = (push.first - info) & POINT_FRAME_MASK; // push.first: number of the frame
    uint traced = age < kStaleLightAge ? (push.first - kStaleLightAge) & POINT_FRAME_MASK : info & POINT_FRAME_MASK;
    // sets the sample count to 0, so that the next sample replaces the colour
    info = (info & ~(POINT_MAX_SAMPLES << POINT_SAMPLES_SHIFT | POINT_FRAME_MASK)) | traced;
    if ((push.bits & REPROJECT_SHAPES) != 0u && (info & POINT_ON_SHAPE) != 0u) info |= POINT_INVALID;
    points[lane()].w = uintBitsToFloat(info);
}

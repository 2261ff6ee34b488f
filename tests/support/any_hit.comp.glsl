// SPDX-License-Identifier: Apache-2.0
// Any-hit intersection of the listed rays, as in shaders/shade/intersect_shadow.comp.glsl but without lights.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/trace/trace_queued.glsl"

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    bool live = (light_masks[path] & 1u) == 0u;
    if (tracePath(path, live ? 1e30 : -1.0).disc != NO_INDEX) atomicOr(light_masks[path], 1u);
}

// SPDX-License-Identifier: Apache-2.0
// Whether the listed rays hit anything: what shaders/shade/shadow.comp.glsl traces and writes, without its light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/trace/trace_queued.glsl"

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    bool asks = (light_masks[path] & 1u) == 0u;
    if (tracePath(path, asks ? 1e30 : -1.0).disc != NO_INDEX) atomicOr(light_masks[path], 1u);
}

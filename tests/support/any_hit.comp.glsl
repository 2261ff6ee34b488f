// SPDX-License-Identifier: Apache-2.0
// Whether the queued rays hit anything: what shaders/light/shadow.comp.glsl traces and writes, without its light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#define ANY_HIT
#include "shaders/trace/trace_queued.glsl"

void main() {
    uint path;
    bool live;
    TraceHit hit = traceQueued(path, live);
    if (live && hit.disc != NO_INDEX) atomicOr(light_masks[path], 1u);
}

// SPDX-License-Identifier: Apache-2.0
// First hits of the queued rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/trace/trace_queued.glsl"

void main() {
    uint path;
    bool live;
    TraceHit hit = traceQueued(path, live);
    storeHit(live, path, hit);
}

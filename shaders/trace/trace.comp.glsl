// SPDX-License-Identifier: Apache-2.0
// First hits of the rays listed for instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/trace_queued.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/store_hit.glsl"

void main() {
    uint path = listEntry(balancedLane());
    bool live = path != NO_INDEX; // others work along, for the list of hits needs the whole subgroup
    path = live ? path : 0u;
    storeHit(live, path, tracePath(path, live ? reachOf(path) : -1.0));
}

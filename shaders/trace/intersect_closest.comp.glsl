// SPDX-License-Identifier: Apache-2.0
// Closest hits on one instance of the rays of LIST_INSTANCE_RAYS, or of what culling left of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/trace_queued.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/store_hit.glsl"

void main() {
    uint path = listEntry(balancedLane());
    bool live = path != NO_INDEX; // idle lanes take part: appending to the hit list needs the whole subgroup
    path = live ? path : 0u;
    storeHit(live, path, tracePath(path, live ? maxDistance(path) : -1.0));
}

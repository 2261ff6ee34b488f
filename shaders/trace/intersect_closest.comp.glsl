// SPDX-License-Identifier: Apache-2.0
// Closest hits of the rays of LIST_INSTANCE_RAYS, or of a culled list, on one instance or on the tiles in a block.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/trace_queued.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/store_hit.glsl"
#ifdef POOLED
#include "shaders/trace/cull.glsl"
#include "shaders/trace/pool_hit.glsl"

bool hitsInTiles(uint path, bool live) {
    QueuedRay ray = queuedRay(path);
    ClosestHit closest = closestBefore(path);
    uint tiles = live ? cullMask(cullRay(ray.origin, ray.direction, closest.t)) : 0u;
    while (tiles != 0u) {
        selectTile(firstTile(tiles));
        takeHit(path, tiles, tracePath(again(path), closest.t * cubeScale()), closest);
        tiles &= tiles - 1u;
    }
    return closest.found;
}
#endif

void main() {
    uint path = listEntry(balancedLane());
    bool live = path != NO_INDEX; // idle lanes take part: appending to the hit list needs the whole subgroup
    path = live ? path : 0u;
#ifdef POOLED
    appendEntry(APPEND_HIT, hitsInTiles(path, live), path);
#else
    storeHit(live, path, tracePath(path, live ? maxDistance(path) : -1.0));
#endif
}

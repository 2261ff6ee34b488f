// SPDX-License-Identifier: Apache-2.0
// Closest hits of the camera rays on one instance, in the tiles of pixels whose beam did not miss it, or on the tiles in
// a block.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/lib/camera_ray.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/store_hit.glsl"
#ifdef POOLED
#include "shaders/trace/pool_beam.glsl"
#include "shaders/trace/pool_hit.glsl"

// tile, pixel: the picture tile of the path, and its pixel there.
bool hitsInTiles(uint path, uint tile, uint pixel, bool live) {
    ClosestHit closest = closestBefore(path);
    uint tiles = live ? beamMask(tile) : 0u;
    while (tiles != 0u) {
        uint place = firstTile(tiles);
        selectTile(place);
        CameraRay ray = cameraRay(tilePixel(tile, again(pixel)));
        TraceRay in_cube = TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), loadBeam(beamPlace(tile, place)),
                                    closest.t * cubeScale(), vec3(0.0), 0.0);
        takeHit(path, tiles, trace(in_cube), closest);
        tiles &= tiles - 1u;
    }
    return closest.found;
}
#endif

void main() {
    uint lane = balancedLane();
    bool queued = lane < control.tile_count * TILE_PIXELS;
    uint tile = loadQueue(queued ? lane / TILE_PIXELS : 0u), index = tile * TILE_PIXELS + lane % TILE_PIXELS;
    bool live = queued && isPixel(index);
    index = live ? index : 0u; // idle lanes take part: appending needs the whole subgroup
#ifdef POOLED
    appendEntry(APPEND_HIT, hitsInTiles(index, tile, lane % TILE_PIXELS, live), index);
#else
    CameraRay ray = cameraRay(tilePixel(tile, lane % TILE_PIXELS));
    storeHit(live, index, trace(TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), loadBeam(tile),
                                         live ? maxDistance(index) : -1.0, vec3(0.0), 0.0)));
#endif
}

// SPDX-License-Identifier: Apache-2.0
// Closest hits on one instance of the camera rays, in the tiles of pixels whose beam did not miss it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/lib/camera_ray.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/store_hit.glsl"

void main() {
    uint lane = balancedLane();
    bool queued = lane < control.tile_count * TILE_PIXELS;
    uint tile = loadQueue(queued ? lane / TILE_PIXELS : 0u), index = tile * TILE_PIXELS + lane % TILE_PIXELS;
    bool live = queued && isPixel(index);
    index = live ? index : 0u; // idle lanes take part: appending needs the whole subgroup
    CameraRay ray = cameraRay(tilePixel(tile, lane % TILE_PIXELS));
    storeHit(live, index, trace(TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), loadBeam(tile),
                                         live ? maxDistance(index) : -1.0, vec3(0.0), 0.0)));
}

// SPDX-License-Identifier: Apache-2.0
// First hits of the camera rays in the tiles that a beam left over.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"
#include "camera_ray.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint lane = balancedLane();
    if (lane >= control.tile_groups.w * TILE_PIXELS) return;
    uint tile = loadQueue(lane / TILE_PIXELS);
    uvec2 pixel = tilePixel(tile, lane % TILE_PIXELS);
    uint index = pixelIndex(pixel);
    if (index == NO_INDEX) return;
    CameraRay ray = cameraRay(pixel);
    storeHit(index, trace(TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), loadBeam(tile), reachOf(index),
                                   vec3(0.0), 0.0)));
}

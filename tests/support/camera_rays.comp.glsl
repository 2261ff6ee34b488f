// SPDX-License-Identifier: Apache-2.0
// The camera rays of shaders/trace/intersect_camera.comp.glsl, in the order of its lanes: first_hits gets the
// directions, film the origins.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/camera_ray.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint lane = gl_GlobalInvocationID.x;
    if (lane >= bandLanes()) return;
    uvec2 pixel = tilePixel(lane / TILE_PIXELS, lane % TILE_PIXELS);
    CameraRay ray = cameraRay(pixel);
    first_hits[lane] = vec4(ray.direction, 0.0);
    film[lane] = vec4(ray.origin, 0.0);
}

// SPDX-License-Identifier: Apache-2.0
// The path that a lane works on: a camera ray in the first pass, a queued one in later passes.
#ifndef POINTRT_SHADERS_PATH_GLSL
#define POINTRT_SHADERS_PATH_GLSL
#include "bindings.glsl"
#include "queue.glsl"
#include "camera_ray.glsl"

const uvec4 kNoHit = uvec4(0x7149F2CAu, NO_INDEX, NO_INDEX, 0u); // t is 1e30

bool isCameraPass() { return push.step.z == 0u; }

// index: of the pixel in the band, NO_INDEX where this lane has none.
PathState currentPath(out uint index) {
    uint lane = balancedLane();
    if (!isCameraPass()) {
        index = queuedIndex(lane);
        return paths[index != NO_INDEX ? index : 0u];
    }
    uint tile = min(lane / TILE_PIXELS, bandTiles() - 1u);
    uvec2 pixel = tilePixel(tile, lane % TILE_PIXELS);
    index = lane < bandLanes() ? pixelIndex(pixel) : NO_INDEX;
    CameraRay ray = cameraRay(pixel);
    return PathState(vec4(ray.origin, 0.0), vec4(ray.direction, 0.0), vec4(1.0),
                     vec4(vec3(0.0), uintBitsToFloat(NO_OWNER << PATH_OWNER_SHIFT)));
}

uint pathBits(PathState path) { return floatBitsToUint(path.left_normal.w); }
uint bounceOf(uint bits) { return bits & PATH_BOUNCE_MASK; }

// Of a pixel of the band in the whole image.
uint imagePixel(uint index) { return index + params.image.z * params.image.x; }

// Dimensions of the sample sequence, in pairs: a pixel's place, then these for each bounce.
#define DIMENSIONS_A_BOUNCE 4u
#define PAIR_DIRECTION 0u
#define PAIR_CHOICES 1u // which lobe, whether to go on
#define PAIR_LIGHT 2u
#define PAIR_LIGHT_CHOICE 3u
uint dimensionPair(uint bounce, uint use) { return 1u + bounce * DIMENSIONS_A_BOUNCE + use; }

#endif

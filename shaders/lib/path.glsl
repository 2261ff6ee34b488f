// SPDX-License-Identifier: Apache-2.0
// The path state of a lane: a camera ray in the camera pass, an entry of the ray queue in later passes.
#ifndef POINTRT_SHADERS_PATH_GLSL
#define POINTRT_SHADERS_PATH_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/features.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/lib/camera_ray.glsl"

const uvec4 kNoHit = uvec4(0x7149F2CAu, NO_INDEX, NO_INDEX, 0u); // t is 1e30

// Paths are numbered like lanes, by tiles of pixels: neighbours in the picture are neighbours in memory.
uvec2 pathPixel(uint path) { return tilePixel(path / TILE_PIXELS, path % TILE_PIXELS); }

PathState cameraPath(uint index) {
    CameraRay ray = cameraRay(pathPixel(index));
    return PathState(ray.origin, 0.0, ray.direction, 0.0, vec3(1.0), 0u, vec3(0.0), NO_OWNER << PATH_OWNER_SHIFT);
}

PathState storedPath(uint index) {
    uvec4 origin = loadPathTexel(index, PATH_ORIGIN), direction = loadPathTexel(index, PATH_DIRECTION),
          throughput = loadPathTexel(index, PATH_THROUGHPUT), left = loadPathTexel(index, PATH_SELF_NORMAL);
    return PathState(asVector(origin), asFloat(origin.w), asVector(direction), asFloat(direction.w), asVector(throughput),
                     throughput.w, asVector(left), left.w);
}

PathState pathOf(uint index) {
    if (kCameraPass) return cameraPath(index);
    return storedPath(index);
}

// The path of this lane. index: its number, NO_INDEX if this lane has no path.
PathState currentPath(out uint index) {
    uint lane = balancedLane();
    index = kCameraPass ? (isPixel(lane) ? lane : NO_INDEX) : queuedIndex(lane);
    return pathOf(index != NO_INDEX ? index : 0u);
}

uint bounceOf(uint bits) { return bits & PATH_BOUNCE_MASK; }

// Pixel of the path in the band, and in the whole image.
uint bandPixel(uint path) {
    uvec2 pixel = pathPixel(path);
    return pixel.y * params.width + pixel.x;
}
uint imagePixel(uint path) { return bandPixel(path) + params.first_row * params.width; }

// Pairs of dimensions of the sample sequence: the position in the pixel, then these for each bounce.
#define PAIRS_PER_BOUNCE 4u
#define PAIR_DIRECTION 0u
#define PAIR_CHOICES 1u // lobe and Russian roulette
#define PAIR_LIGHT 2u
#define PAIR_LIGHT_CHOICE 3u
uint dimensionPair(uint bounce, uint use) { return 1u + bounce * PAIRS_PER_BOUNCE + use; }

#endif

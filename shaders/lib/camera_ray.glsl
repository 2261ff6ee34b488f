// SPDX-License-Identifier: Apache-2.0
// Camera rays, generated where they are needed: computing one is faster than loading it.
#ifndef POINTRT_SHADERS_CAMERA_RAY_GLSL
#define POINTRT_SHADERS_CAMERA_RAY_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/lib/random.glsl"
#include "shaders/shared/panorama.h"
#include "shaders/shared/spec_constants.h"

// A specialization constant: lavapipe recompiles a program at each binding if a branch depends on a value in params.
layout(constant_id = SPEC_PANORAMA_EYES) const uint kPanoramaEyes = 0u;
const bool kIsPanorama = kPanoramaEyes != 0u, kIsStereo = kPanoramaEyes == 2u;

// Pixels are ordered in tiles of 8 x 8, and within a tile in blocks of 4 x 2, one for the 8 lanes of lavapipe.
uvec2 tileCorner(uint tile) {
    // in floats: integer division is slow; exact below 2^22 tiles
    uint row = uint((float(tile) + 0.5) / float(tilesAcross()));
    return uvec2(tile - row * tilesAcross(), row) * TILE_SIDE;
}

uvec2 tilePixel(uint tile, uint lane) {
    return tileCorner(tile) + uvec2((lane >> 1 & 4u) | (lane & 3u), (lane >> 3 & 6u) | (lane >> 2 & 1u));
}

// False for lanes of tiles that extend beyond the borders of the band.
bool isPixel(uint lane) {
    uvec2 pixel = tilePixel(lane / TILE_PIXELS, lane % TILE_PIXELS);
    return lane < bandLanes() && pixel.x < params.width && pixel.y < params.rows;
}

// Position of the sample within its pixel: the R2 sequence (Roberts 2018), with steps of 1/p and 1/p^2 for the plastic
// number p, in units of 2^-32 so that late samples lose no bits; shifted differently in each pixel.
vec2 samplePosition(uint pixel) {
    if (hasStep(STEP_CENTER)) return vec2(0.5);
    uvec2 steps = push.sample_index * uvec2(0xC13FA9A9u, 0x91E10DA6u);
    uvec2 shift = pcg3(uvec3(pixel, 0u, params.seed * 0x9E3779B9u)).xy;
    return fract(vec2(shift >> 8u) * (1.0 / 16777216.0) + vec2(steps >> 8u) * (1.0 / 16777216.0));
}

struct CameraRay {
    vec3 origin;
    vec3 direction;
};

// Corner, in the picture, of a pixel of the band. Computed in integers, so that rays do not depend on the bands.
vec2 pixelCorner(uvec2 pixel) { return vec2(pixel.x, pixel.y + params.first_row); }

// Position in pixels of the picture to a position on an image plane of this half height, x right and y up from its
// centre.
vec2 onPlane(vec2 pixel, float half_height) {
    vec2 at = pixel / vec2(params.picture_width, params.picture_height);
    return vec2(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y) * half_height * vec2(params.aspect, 1.0);
}

vec3 displaced(vec3 middle, vec2 plane) { return middle + plane.x * params.right + plane.y * params.up; }

// A panorama's longitude, 0 at forward and growing to the right, and latitude over the horizon. In stereo the left
// eye's picture is above the right eye's.
vec2 panoramaAngles(vec2 pixel) {
    vec2 at = pixel / vec2(params.picture_width, params.picture_height);
    if (kIsStereo) at.y = fract(2.0 * at.y);
    return vec2((2.0 * at.x - 1.0) * kPi, (0.5 - at.y) * kPi);
}

// Distance of an eye to the right of the middle of the head, at a latitude with this cosine.
float eyeAside(vec2 pixel, float cosine) {
    bool is_left = 2.0 * pixel.y < float(params.picture_height);
    return (is_left ? -1.0 : 1.0) * params.half_eye_distance * min(1.0, cosine / PANORAMA_FULL_STEREO_COSINE);
}

// The head turns to each longitude, about the up direction, and the eyes turn with it.
CameraRay panoramaRay(vec2 pixel) {
    vec2 angles = panoramaAngles(pixel);
    float sine = sin(angles.x), cosine = cos(angles.x), level = cos(angles.y);
    vec3 direction = level * (sine * params.right + cosine * params.forward) + sin(angles.y) * params.up;
    vec3 aside = cosine * params.right - sine * params.forward;
    return CameraRay(params.eye + eyeAside(pixel, level) * aside, normalize(direction));
}

// One formula for both projections onto a plane. Pinhole: origins coincide (half_window is 0) and directions spread
// over the plane at distance 1. Parallel projection: origins spread over the image plane and directions coincide.
CameraRay rayThrough(vec2 pixel) {
    if (kIsPanorama) return panoramaRay(pixel);
    return CameraRay(displaced(params.eye, onPlane(pixel, params.half_window)),
                     normalize(displaced(params.forward, onPlane(pixel, params.tan_half_fov))));
}

// This sample's ray through a pixel of the band; with STEP_PIXEL_LIST, through the centre of the pixel listed for it.
CameraRay cameraRay(uvec2 pixel) {
    uint word = loadListedPixel(pixel.y * params.width + pixel.x);
    if (hasStep(STEP_PIXEL_LIST)) return rayThrough(vec2(word & 0xFFFFu, word >> 16) + 0.5);
    return rayThrough(pixelCorner(pixel) + samplePosition((pixel.y + params.first_row) * params.width + pixel.x));
}

#endif

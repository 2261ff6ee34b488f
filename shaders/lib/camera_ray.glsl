// SPDX-License-Identifier: Apache-2.0
// Camera rays, made where they are needed: computing one takes less time than reading it.
#ifndef POINTRT_SHADERS_CAMERA_RAY_GLSL
#define POINTRT_SHADERS_CAMERA_RAY_GLSL
#include "shaders/lib/random.glsl"

// Pixels are taken in tiles of 8 x 8, and those in blocks of 4 x 2, which lavapipe's 8 lanes share.
uvec2 tileCorner(uint tile) {
    // in floats, because integer division is slow; exact below 2^22 tiles
    uint row = uint((float(tile) + 0.5) / float(tilesAcross()));
    return uvec2(tile - row * tilesAcross(), row) * TILE_SIDE;
}

uvec2 tilePixel(uint tile, uint lane) {
    return tileCorner(tile) + uvec2((lane >> 1 & 4u) | (lane & 3u), (lane >> 3 & 6u) | (lane >> 2 & 1u));
}

// Whether the lane has a pixel: some tiles reach beyond the band's borders.
bool isPixel(uint lane) {
    uvec2 pixel = tilePixel(lane / TILE_PIXELS, lane % TILE_PIXELS);
    return lane < bandLanes() && pixel.x < params.width && pixel.y < params.rows;
}

// R2 sequence (Roberts 2018): steps of 1/p and 1/p^2 for the plastic number p in units of 2^-32, so that late samples
// lose no bits; shifted per pixel.
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

// The corner of a pixel of the band in the picture. In integers: a picture's rays are the same in whatever bands.
vec2 pixelCorner(uvec2 pixel) { return vec2(pixel.x, pixel.y + params.first_row); }

// Where a place of the picture, in pixels, is in a window so high, to the right and up from its middle.
vec2 onPlane(vec2 place, float half_height) {
    vec2 at = place / vec2(params.picture_width, params.picture_height);
    return vec2(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y) * half_height * vec2(params.aspect, 1.0);
}

vec3 displaced(vec3 middle, vec2 plane) { return middle + plane.x * params.right + plane.y * params.up; }

// One formula for both projections: rays of a pinhole spread over the plane at distance 1 and start in a window without
// extent, those of a parallel projection the other way round.
CameraRay rayThrough(vec2 place) {
    return CameraRay(displaced(params.eye, onPlane(place, params.half_window)),
                     normalize(displaced(params.forward, onPlane(place, params.tan_half_fov))));
}

// This sample's ray through a pixel of the band, or through the middle of the one whose place is listed in its stead.
CameraRay cameraRay(uvec2 pixel) {
    uint word = loadPlace(pixel.y * params.width + pixel.x);
    if (hasStep(STEP_PLACES)) return rayThrough(vec2(word & 0xFFFFu, word >> 16) + 0.5);
    return rayThrough(pixelCorner(pixel) + samplePosition((pixel.y + params.first_row) * params.width + pixel.x));
}

#endif

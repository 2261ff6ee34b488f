// SPDX-License-Identifier: Apache-2.0
// What the host hands to the shaders: one header for C++ and GLSL, so that no struct is written twice.
// Members are 16-byte vectors only: both languages then agree on every offset without padding.
#ifndef POINTRT_SHADERS_PARAMS_H
#define POINTRT_SHADERS_PARAMS_H

#ifdef __cplusplus
#include <cstdint>
namespace pointrt::gpu {
using uint = std::uint32_t;
struct vec4 {
    float x, y, z, w;
};
struct uvec4 {
    uint x, y, z, w;
};
#endif

// Lanes of a workgroup. Large groups are a quarter faster than 64 on lavapipe, and no GPU has fewer than 128.
#define WORKGROUP_SIZE 128

#define MAX_LIGHTS 16

// Pixels that share a beam.
#define TILE_SIDE 8u
#define TILE_PIXELS 64u
// Its length where it passes everything.
#define BEAM_MISSES 1e30f

// Share of the sky's light taken as ambient by phong and whitted, standing in for what bounces around a scene.
#define AMBIENT_SHARE 0.16f
// The sky, linear: between these by the square root of the height over the horizon.
#define SKY_ZENITH 0.46f, 0.52f, 0.62f
#define SKY_HORIZON 0.82f, 0.83f, 0.84f
#define SKY_GROUND 0.30f, 0.29f, 0.28f

#define INTEGRATOR_PHONG 0
#define INTEGRATOR_WHITTED 1
#define INTEGRATOR_PATH 2
#define INTEGRATOR_NORMAL 3
#define INTEGRATOR_DEPTH 4

#define ROOM_NONE 0
#define ROOM_MIRROR 1
#define ROOM_MATTE 2

#define OPTION_BLEND 1u
#define OPTION_SHADOWS 2u
#define OPTION_ORIENTED 4u
#define OPTION_OVERRIDE_REFLECTIVITY 8u

// Marks a lane without a pixel, in queues, and a ray without a hit.
#define NO_INDEX 0xFFFFFFFFu

// All positions and lengths are in cube units.
struct FrameParams {
    vec4 eye;        // w: tangent of half the vertical field of view
    vec4 right;      // w: width over height
    vec4 up;
    vec4 forward;
    vec4 splat;      // x: radius_max, y: radius_step, z: blend_slab, w: overriding reflectivity
    vec4 room_lo;
    vec4 room_hi;
    vec4 grid_scale; // x: entry grid cells in a cube unit, y: words in a row, z: in a layer, w: one position step in cells
    vec4 sky_up;     // xyz: unit vector upwards, w: distance at which the depth view is black
    uvec4 image;     // x: width, y: height of the image, z: first row, w: rows of the band
    uvec4 scene;     // x: lights, y: OPTION_* bits
    uvec4 grid_origin; // xyz: lowest cell, in cells from the cube's corner
    uvec4 grid_size;   // xyz: cells, w: last word
    uvec4 mode;      // x: INTEGRATOR_*, y: bounces, z: ROOM_*, w: seed
    vec4 light_position[MAX_LIGHTS]; // w unused
    vec4 light_power[MAX_LIGHTS];    // radiance a white matte surface facing the light shows, times distance squared
};

// Counters and the group counts of indirect dispatches.
struct Control {
    uvec4 ray_groups; // indirect arguments of trace and shade
    uvec4 lit_groups; // indirect arguments of shadow
    uvec4 tile_groups; // indirect arguments of trace_primary; w: tiles in queue 0
    uvec4 queued;     // x, y: rays in queue 0 and 1, z: lit points being appended, w: lit points being shaded
    uvec4 traced;     // x: primary, y: shadow, z: secondary rays of this sample
};

// A path between two dispatches.
struct PathState {
    vec4 origin;      // w: hits nearer than this on the surface the ray left are its own
    vec4 direction;
    vec4 throughput;
    vec4 left_normal; // of the surface the ray left, 0 for the room's walls
};

// A surface point that wants light.
struct LitPoint {
    vec4 position; // w: radius of the splats around
    vec4 normal;   // towards the viewer; w: Phong exponent
    vec4 diffuse;  // what a light of unit radiance adds at normal incidence; w: weight of the highlight
    vec4 view;     // towards the viewer
};

struct PushParams {
    uvec4 step; // x: sample, z: bounce, w: STEP_* bits
};

#define STEP_CENTER 1u     // rays go through pixel centres
#define STEP_FIRST_HIT 2u  // shading only records the first hit
#define STEP_RESET 4u      // prepare: the start of a sample
#define STEP_QUEUE_ONE 8u  // rays are read from queue 1 and appended to queue 0

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif

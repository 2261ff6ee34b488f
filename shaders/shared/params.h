// SPDX-License-Identifier: Apache-2.0
// What the host hands to the shaders: one header for C++ and GLSL, so that no struct is written twice.
#ifndef POINTRT_SHADERS_PARAMS_H
#define POINTRT_SHADERS_PARAMS_H

#include "shaders/shared/environment_layout.h"
#include "shaders/shared/photon_layout.h"
#include "shaders/shared/scene_layout.h"

#ifdef __cplusplus
namespace pointrt::gpu {
#endif

// Lanes of a workgroup. Large groups are a quarter faster than 64 on lavapipe, and no GPU has fewer than 128.
#define WORKGROUP_SIZE 128

// Pixels that share a beam.
#define TILE_SIDE 8u
#define TILE_PIXELS 64u
// Its length where it passes everything.
#define BEAM_MISSES 1e30f

#define INTEGRATOR_PHONG 0
#define INTEGRATOR_WHITTED 1
#define INTEGRATOR_PATH 2
#define INTEGRATOR_NORMAL 3
#define INTEGRATOR_DEPTH 4

// Kinds that a scene has (shaders/frame/features.glsl).
#define FEATURE_LIGHT(kind) (1u << uint(kind))
#define FEATURE_MATERIAL(kind) (1u << (8u + uint(kind)))
#define FEATURE_SHAPE(kind) (1u << (16u + uint(kind)))
#define FEATURE_GOES_ON (1u << 31) // some surface may send rays on

#define OPTION_BLEND 1u
#define OPTION_SHADOWS 2u

// Marks a lane without a pixel, in queues, and a ray without a hit.
#define NO_INDEX 0xFFFFFFFFu

// A hit's owner: an instance's number, or this for shapes.
#define OWNER_SHAPES 255u

// All positions and lengths are in render units.
struct FrameParams {
    vec4 eye;   // w: tangent of half the vertical field of view, 0 with parallel projection
    vec4 right; // w: width over height
    vec4 up;    // w: half the window's height with parallel projection, 0 for a pinhole
    vec4 forward;
    vec4 sky_zenith; // radiance by the square root of the height over the horizon; w: share taken as ambient
    vec4 sky_horizon;
    vec4 sky_ground;
    vec4 sky_up;    // xyz: unit vector upwards, w: distance at which the depth view is black
    uvec4 image;    // x: width, y: height of the image, z: first row, w: rows of the band
    uvec4 scene;    // x: lights, y: OPTION_* bits, z: shapes, w: the sky's light, NO_LIGHT where it has no image
    uvec4 film;     // x: pixels of the film, y: the first of the band in it
    uvec4 mode;     // x: INTEGRATOR_*, y: bounces, w: seed
    vec4 reach_low; // corners of a box around all that instances may be hit in; without any, low is above high
    vec4 reach_high;
    EnvironmentFrame environment;
    CausticFrame caustics;
};

// Counters and the group counts of indirect dispatches.
struct Control {
    uvec4 ray_groups;   // indirect arguments of trace and shade
    uvec4 light_groups; // indirect arguments of shadow_shapes and light
    uvec4 asked_groups; // indirect arguments of trace and shadow; w: rays in their list
    uvec4 hit_groups;   // indirect arguments of surface; w: hits in its list
    uvec4 tile_groups;  // indirect arguments of trace_primary; w: tiles in queue 0
    uvec4 queued;       // x, y: rays in queue 0 and 1, z: light queries being appended, w: those being answered
    uvec4 appended;     // x: rays to the list that trace and shadow read next, y: hits to that of surface
    uvec4 traced;       // x: primary, y: shadow, z: secondary rays of this sample
};

// A path between two dispatches.
struct PathState {
    vec4 origin;    // w: hits nearer than this on the surface the ray left are its own
    vec4 direction; // w: density of the direction's choice, over solid angle; 0: there was no other
    vec4 throughput;
    vec4 left_normal; // of the surface the ray left; w: as bits, PATH_*
};
#define PATH_BOUNCE_MASK 0xFFu
#define PATH_DEFERRED_SHIFT 8u // rays of the pixel that wait in deferred, 0 to MAX_DEFERRED
#define PATH_DEFERRED_MASK 0xFu
#define PATH_DIFFUSED 0x1000u // but for mirrors and glass, what scattered it last gathers photons
#define PATH_INSIDE 0x2000u   // in glass whose normals tell no sides
#define PATH_CAUSTIC 0x4000u  // what it finds of lamps, photons have brought
#define PATH_OWNER_SHIFT 24u  // whose surface it left, NO_OWNER at the eye
#define NO_OWNER 254u

// Rays of a pixel that wait while another one is followed.
#define MAX_DEFERRED 2u

// What a ray has hit, as shading sees it.
struct SurfacePoint {
    vec4 position; // w: mean radius of the splats around, 0 on shapes
    vec4 normal;   // towards the viewer; w: as bits, material and SURFACE_BACK
    vec4 albedo;   // linear; w: distance along the ray
    uvec4 id;      // x: splat, y: owner, z: 1: casts caustics
};
#define SURFACE_VECTORS 4
#define SURFACE_MATERIAL_MASK 0xFFFFFFu
#define SURFACE_SIDED 0x40000000u // normals point outwards
#define SURFACE_BACK 0x80000000u  // seen from the inside

// A surface point that wants light.
struct DirectLightQuery {
    vec4 position;   // w: radius of the splats around
    vec4 normal;     // towards the viewer; w: as bits, material
    vec4 albedo;     // w: as bits, owner
    vec4 throughput; // w: as bits, the path's bounce
    vec4 view;       // towards the viewer; w: -1 where normal is the stored one turned round, else 1
};
#define LIGHT_QUERY_VECTORS 5

// What is known of a pixel, in vectors of film, layer after layer: sums over the samples.
#define LAYER_DIRECT 0u   // light scattered once, and what is seen itself; w: share covered by the scene
#define LAYER_INDIRECT 1u // w: luminance of the sample under way
#define LAYER_CAUSTIC 2u  // w: squared luminance of the samples before
#define LAYER_ALBEDO 3u
#define FILM_LAYERS 4u

// first_hits, of a pixel: normal and t (negative: nothing is hit); as bits, splat or shape, and owner.
#define FIRST_HIT_VECTORS 2u

struct PushParams {
    uvec4 step; // x: sample, y: first of the turns asked for shadows, w: STEP_* bits
};

// A photon's target, in its direction's w as bits: an owner, with the number of a shape above it.
#define PHOTON_SHAPE_SHIFT 8u

#define STEP_CENTER 1u    // rays go through pixel centres
#define STEP_FIRST_HIT 2u // of them only what is hit first is kept
#define STEP_RESET 4u     // prepare: the start of a sample
#define STEP_QUEUE_ONE 8u // rays are read from queue 1 and appended to queue 0
#define STEP_PREVIEW 16u  // lamps are asked in the middle, and the first alone for shadows: pictures at once
#define STEP_ASKED 32u    // prepare: the list of rays for instances is complete
#define STEP_HITS 64u     // prepare: the list of an instance's hits is complete

// A shadow ray in the list of those that instances are asked for: a path, and above it the turn of its light.
#define ASKED_TURN_SHIFT 27u
// Turns that the list has room for; where there are more, they are taken in several goes.
#define ASKED_TURNS 8u

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif

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

// Kinds that a scene has (shaders/lib/features.glsl).
#define FEATURE_LIGHT(kind) (1u << uint(kind))
#define FEATURE_MATERIAL(kind) (1u << (8u + uint(kind)))
#define FEATURE_SHAPE(kind) (1u << (16u + uint(kind)))
#define FEATURE_HIGHLIGHTS (1u << 28)       // some material has Phong's
#define FEATURE_LIGHT_ON_THE_WAY (1u << 29) // fused, paths ask for light in registers; else points of lists do
#define FEATURE_NOISE (1u << 30)            // some scan is noisy
#define FEATURE_GOES_ON (1u << 31)          // some surface may send rays on

#define OPTION_BLEND 1u
#define OPTION_SHADOWS 2u

// Marks a lane without a pixel, in queues, and a ray without a hit.
#define NO_INDEX 0xFFFFFFFFu

// A hit's owner: an instance's number, or this for shapes.
#define OWNER_SHAPES 255u

// All positions and lengths are in render units.
struct FrameParams {
    vec3 eye;
    float tan_half_fov; // of the vertical field of view; 0 with parallel projection
    vec3 right;
    float aspect; // width over height
    vec3 up;
    float half_window; // half the window's height with parallel projection, 0 for a pinhole
    vec3 forward;
    float unused_0;
    vec3 sky_zenith;     // radiance by the square root of the height over the horizon
    float ambient_share; // of the sky, that phong and whitted take as light from everywhere
    vec3 sky_horizon;
    float unused_1;
    vec3 sky_ground;
    float unused_2;
    vec3 sky_up;       // unit vector
    float depth_black; // distance at which the depth view is black
    uint width;        // of the image
    uint height;
    uint first_row; // of the band, which begins with one of the picture's tiles or ends in that which it begins in
    uint rows;
    uint light_count;
    uint options; // OPTION_*
    uint shape_count;
    uint sky_light;     // the sky's light, NO_LIGHT where it has no image
    uint film_pixels;   // of the film
    uint film_first;    // the first of the band in it
    uint picture_width; // that places on it are told in: the image's, whatever the band is like
    uint picture_height;
    uint integrator; // number of one of INTEGRATORS
    uint bounces;
    uint unused_5;
    uint seed;
    vec3 reach_low; // corners of a box around all that instances may be hit in; without any, low is above high
    float unused_6;
    vec3 reach_high;
    float unused_7;
    EnvironmentFrame environment;
    CausticFrame caustics;
    Shape held_shapes[HELD_SHAPES]; // the scene's, where it has no more
};

// Lists of entries in queues, by number.
#define LIST_LIT 0u    // light queries that are being answered, or shadow rays of paths: shadow_shapes, light, caustic
#define LIST_ASKED 1u  // rays for instances: trace
#define LIST_TURNS 2u  // shadow rays for instances: shadow
#define LIST_SIFTED 3u // the first of those that the targets of a sieve have of one of these
// Targets, which are instances, that a ray is held against at once: bits of a word.
#define SIEVE_TARGETS 32u
#define LISTS 35u // LIST_SIFTED + SIEVE_TARGETS

struct RayList {
    uvec3 groups; // of a dispatch over it
    uint count;
    uint start;    // in queues
    uint appended; // for prepare to take
    uint placed;   // of a sifted one: entries that are there already
    uint unused;
};

// Counters, and the group counts of indirect dispatches with the length of the list that each works on.
struct Control {
    uvec3 ray_groups; // trace_shapes, shade
    uint unused_0;
    uvec3 hit_groups; // surface
    uint hit_count;
    uvec3 tile_groups;  // trace_primary
    uint tile_count;    // in queue 0
    uint queued[2];     // rays in the queues
    uint hits_appended; // to the list that surface reads next
    uint primary_rays;  // of this sample
    uint shadow_rays;
    uint secondary_rays;
    uint unused_1;
    uint unused_2;
    RayList lists[LISTS];
};

// Boxes that rays are held against before the targets in them are asked, each by itself. They are told in whole steps,
// so that a box is two words: for lavapipe loads are what a sieve takes.
struct Sieve {
    vec4 row_x; // from render space to steps along the boxes' axes: a similarity; w: translation
    vec4 row_y;
    vec4 row_z;
    uvec4 targets;                   // x: a bit for each there is
    uvec4 boxes[SIEVE_TARGETS / 2u]; // x, y of an even target, z, w of the next: middle and half edges
};
// Of these x is lowest.
#define SIEVE_BITS 10u
#define SIEVE_STEPS 1023u
// Of the largest coordinate of a ray's start or of a box, rounding makes less than this: a few times 2^-24 for each of
// turning them into the sieve's frame, into a tile's, and the products there.
#define SIEVE_ROUNDING 2e-6f
// Entries that the lists of a sieve's targets have room for, a lane: two targets for each of the most shadow rays there
// may be. A target whose list does not fit is asked for all rays.
#define SIFTED_ENTRIES 16u

// A path between two dispatches.
struct PathState {
    vec3 origin;
    float own_t; // hits nearer than this on the surface the ray left are its own
    vec3 direction;
    float pdf; // density of the direction's choice, over solid angle; 0: there was no other
    vec3 throughput;
    uint target;      // of a photon that sets out: an owner, with the number of a shape above it
    vec3 left_normal; // of the surface the ray left
    uint bits;        // PATH_*
};
#define PATH_VECTORS 4
#define PATH_BOUNCE_MASK 0xFFu
#define PATH_DEFERRED_SHIFT 8u // rays of the pixel that wait in deferred, 0 to MAX_DEFERRED
#define PATH_DEFERRED_MASK 0xFu
#define PATH_DIFFUSED 0x1000u // but for mirrors and glass, what scattered it last gathers photons
#define PATH_INSIDE 0x2000u   // in glass whose normals tell no sides
#define PATH_CAUSTIC 0x4000u  // what it finds of lamps, photons have brought
#define PATH_OWNER_SHIFT 24u  // whose surface it left, NO_OWNER at the eye
#define NO_OWNER 254u
#define PHOTON_SHAPE_SHIFT 8u // in a photon's target

// Rays of a pixel that wait while another one is followed.
#define MAX_DEFERRED 2u

// What a ray has hit, as shading sees it. Of splats it is kept between two dispatches.
struct SurfaceInteraction {
    vec3 position;
    float radius; // mean of the splats around, more where they are noisy (ownRadius), 0 on shapes
    vec3 normal;  // towards the viewer
    uint bits;    // material and SURFACE_*
    vec3 albedo;  // linear
    float t;      // along the ray; negative: nothing is hit
    uint owner;
    uint primitive; // splat, or shape
    uint tile;      // 1 + number of the splat's tile in its set, 0: it is of no set
    uint unused;
};
#define SURFACE_VECTORS 4
#define SURFACE_MATERIAL_MASK 0xFFFFFFu
#define SURFACE_REACH_SHIFT 24u // how far rays that leave it may meet it again (shaders/trace/offset.glsl)
#define SURFACE_REACH_MASK 31u
#define SURFACE_CASTS 0x20000000u // caustics: photons go by way of it
#define SURFACE_SIDED 0x40000000u // normals tell inside from outside; scans without oriented normals do not
#define SURFACE_BACK 0x80000000u  // seen from the inside

// A point of a surface that asks for the light of lamps.
struct DirectLightQuery {
    vec3 position;
    float radius;  // as of the surface
    vec3 normal;   // towards the viewer
    uint material; // and its SURFACE_REACH
    vec3 albedo;
    uint owner;
    vec3 throughput;
    uint bounce; // of the path
    vec3 view;   // towards the viewer
    float side;  // -1 where normal is the stored one turned round, else 1
};
#define LIGHT_QUERY_VECTORS 5

// The fused form's: a shadow ray that is to pass the instances, and what it brings then.
struct ShadowRay {
    vec3 origin;
    float own_t; // as of a PathState
    vec3 direction;
    float t_max; // up to the lamp; negative: something stands in its way
    vec3 left_normal;
    uint owner; // of the surface it left
    vec3 light;
    uint scatterings; // of the light on its way to the eye
};
#define SHADOW_RAY_VECTORS 4

// What is known of a pixel, in vectors of film, layer after layer: sums over the samples.
#define LAYER_DIRECT 0u   // light scattered once, and what is seen itself; w: share covered by the scene
#define LAYER_INDIRECT 1u // w: luminance of the sample under way
#define LAYER_CAUSTIC 2u  // w: squared luminance of the samples before
#define LAYER_ALBEDO 3u
#define FILM_LAYERS 4u

// first_hits, of a pixel: normal and t (negative: nothing is hit); as bits, splat or shape, owner with a tile above
// it (HIT_TILE_SHIFT) and material; how much of it hangs on the view, 0 to 1.
#define FIRST_HIT_VECTORS 2u

struct PushParams {
    uint sample_index;
    uint first_turn; // of those asked for shadows
    uint step;       // STEP_*
    uint list;       // LIST_* or after: that a program goes by
};

#define STEP_CENTER 1u    // rays go through pixel centres
#define STEP_FIRST_HIT 2u // of them only what is hit first is kept
#define STEP_RESET 4u     // prepare: the start of a sample
#define STEP_QUEUE_ONE 8u // rays are read from queue 1 and appended to queue 0
#define STEP_PREVIEW 16u  // lamps are asked in the middle, and the first alone for shadows: pictures at once
#define STEP_LIST 32u     // prepare: the list is complete
#define STEP_HITS 64u     // prepare: the list of an instance's hits is complete
#define STEP_LAST 128u    // shadow_light: no instance comes after this one
#define STEP_PLACES 256u  // rays go through the pixels that places names, one a lane
#define STEP_SIFTED 512u  // prepare: the entries of the sifted lists are counted

// A shadow ray in the list of those that instances are asked for: a path, and above it the turn of its light.
#define ASKED_TURN_SHIFT 27u
// Turns that the list has room for. Where there are more, they are taken in several goes.
#define ASKED_TURNS 8u

#ifdef __cplusplus
POINTRT_ROWS(FrameParams, 14 + sizeof(EnvironmentFrame) / 16 + sizeof(CausticFrame) / 16 + HELD_SHAPES * SHAPE_VECTORS);
POINTRT_ROW(FrameParams, sky_up);
POINTRT_ROW(FrameParams, width);
POINTRT_ROW(FrameParams, reach_low);
POINTRT_ROW(FrameParams, environment);
POINTRT_ROW(FrameParams, held_shapes);
POINTRT_ROWS(RayList, 2);
static_assert(LISTS == LIST_SIFTED + SIEVE_TARGETS);
POINTRT_ROWS(Control, 5 + 2 * LISTS);
POINTRT_ROW(Control, tile_groups);
POINTRT_ROW(Control, queued);
POINTRT_ROW(Control, lists);
POINTRT_ROWS(Sieve, 4 + SIEVE_TARGETS / 2);
POINTRT_ROWS(PathState, PATH_VECTORS);
POINTRT_ROW(PathState, left_normal);
POINTRT_ROWS(SurfaceInteraction, SURFACE_VECTORS);
POINTRT_ROW(SurfaceInteraction, owner);
POINTRT_ROWS(DirectLightQuery, LIGHT_QUERY_VECTORS);
POINTRT_ROW(DirectLightQuery, view);
POINTRT_ROWS(ShadowRay, SHADOW_RAY_VECTORS);
POINTRT_ROWS(PushParams, 1);
} // namespace pointrt::gpu
#endif

#endif

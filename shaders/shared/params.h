// SPDX-License-Identifier: Apache-2.0
// Frame parameters, queues, path state and hits, as host and shaders share them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PARAMS_H
#define POINTRT_SHADERS_PARAMS_H

#include "shaders/shared/environment_layout.h"
#include "shaders/shared/photon_layout.h"
#include "shaders/shared/scene_layout.h"

#ifdef __cplusplus
namespace pointrt::gpu {
#endif

// Lanes of a workgroup. On lavapipe, groups this large are a quarter faster than groups of 64; every GPU allows 128.
#define WORKGROUP_SIZE 128

// Square tile of pixels whose camera rays share a beam.
#define TILE_SIDE 8u
#define TILE_PIXELS 64u
// Free distance of a beam that misses everything. Each pooled tile has its own beams.
#define BEAM_MISSES 1e30f

// Features of a scene (shaders/lib/features.glsl).
#define FEATURE_LIGHT(kind) (1u << uint(kind))
#define FEATURE_MATERIAL(kind) (1u << (8u + uint(kind)))
#define FEATURE_SHAPE(kind) (1u << (16u + uint(kind)))
#define FEATURE_CLIPS (1u << 25)      // clips cut at least one instance
#define FEATURE_RELIGHT (1u << 26)    // Gaussians are surfaces that the scene lights
#define FEATURE_GAUSSIANS (1u << 27)  // at least one instance holds Gaussians
#define FEATURE_HIGHLIGHTS (1u << 28) // at least one material has a Phong highlight
#define FEATURE_INLINE_NEE (1u << 29) // the megakernel samples lights itself; else it queues direct-lighting queries
#define FEATURE_NOISE (1u << 30)      // at least one scan stores noise
#define FEATURE_SECONDARY_RAYS (1u << 31) // at least one surface may reflect, refract or scatter rays

#define OPTION_BLEND 1u
#define OPTION_SHADOWS 2u
#define OPTION_TRANSPARENT 4u // nothing is behind the scene: Gaussians are not composited over the sky

// Marks a lane without a pixel, an empty queue entry, and a ray without a hit.
#define NO_INDEX 0xFFFFFFFFu

// The owner of a hit: number of the instance, or this for shapes.
#define OWNER_SHAPES 255u

// All positions and lengths are in render units.
struct FrameParams {
    vec3 eye;
    float tan_half_fov; // tangent of half the vertical field of view; 0 with parallel projection
    vec3 right;
    float aspect; // width / height
    vec3 up;
    float half_window; // half the height of the image plane with parallel projection; 0 for a pinhole
    vec3 forward;
    float unused_0;
    vec3 sky_zenith;     // radiance by the square root of the height over the horizon
    float ambient_share; // share of the sky's light that phong and whitted add as unshadowed ambient light
    vec3 sky_horizon;
    float half_eye_distance; // for stereo panoramas
    vec3 sky_ground;
    float unused_2;
    vec3 sky_up;       // unit vector
    float depth_black; // distance at which the depth view is black
    uint width;        // width of the image
    uint height;
    uint first_row; // of the band; a band starts at a tile boundary, or ends within the tile in which it starts
    uint rows;
    uint light_count;
    uint options; // OPTION_*
    uint shape_count;
    uint sky_light;     // index of the light that samples the sky image, or NO_LIGHT
    uint film_pixels;   // pixels of the film
    uint film_first;    // index in the film of the first pixel of the band
    uint picture_width; // of the whole picture; width and height describe the band's image
    uint picture_height;
    uint integrator; // number of one of INTEGRATORS
    uint bounces;
    uint unused_5;
    uint seed;
    vec3 instances_low; // corners of the box around all instances; without instances low is above high
    float unused_6;
    vec3 instances_high;
    float unused_7;
    EnvironmentFrame environment;
    CausticFrame caustics;
    Shape held_shapes[HELD_SHAPES]; // the scene's shapes, if there are at most this many
};

// Lists in the queue buffer, named by what they hold.
#define LIST_DIRECT_LIGHT 0u  // paths with a DirectLightQuery (wavefront), or with a ShadowRay (megakernel)
#define LIST_INSTANCE_RAYS 1u // paths whose ray may hit instances: intersect_closest
#define LIST_SHADOW_RAYS 2u   // shadow rays that instances may occlude: intersect_shadow
// the first of the culled lists, one per instance of a cull group: what culling left of one of the lists above
#define LIST_CULLED 3u
// Instances that one culling pass tests a ray against: bits of a cull mask.
#define CULL_INSTANCES 32u
#define LISTS 35u // LIST_CULLED + CULL_INSTANCES

struct RayList {
    uvec3 groups; // workgroups of an indirect dispatch over the list
    uint count;
    uint start;     // index in queues
    uint appended;  // entries appended so far; prepare turns them into count
    uint compacted; // culled lists: entries that compact has written
    uint hits;      // culled lists: rays that have hit the pooled tile (STEP_COUNT_HITS)
};

// Counters, and for each indirect dispatch its group count and the length of its list.
struct Control {
    uvec3 ray_groups; // intersect_shapes, shade_surface
    uint unused_0;
    uvec3 hit_groups;  // surface
    uint hit_count;    // in the hit list
    uvec3 tile_groups; // intersect_camera
    uint tile_count;   // in queue 0
    uint queued[2];    // paths in the two ray queues
    uint unused_1;
    uint primary_rays; // rays of this sample, by kind
    uint shadow_rays;
    uint secondary_rays;
    uint cut_rays; // rays ended before all Gaussians along them were tested
    uint unused_2;
    RayList lists[LISTS];
};

// Per path: the light that Gaussians add in front of its hit.
struct GaussianLight {
    vec4 light; // a: the share that passes from behind
    vec4 last;  // x: t of the last Gaussian added, kWalkEnded if none follow; y: its number
    // xyz: the normal of the Gaussian behind which less than half passes; w: its t in render space; kWalkEnded if more
    // passes
    vec4 middle;
    // If the scene lights Gaussians: until all are composited, last.z is the most that one Gaussian adds, last.w that
    // Gaussian's radius, and middle.xyz the sum of normals. After that, last.yzw is the albedo, and middle.xyz the
    // normal scaled to the length of the radius.
};

// A Gaussian that waits to be composited in the order of all instances.
struct WaitingGaussian {
    float t; // of its peak, render units
    uint gaussian;
    uint instance;     // its place among the scene's instances; in the high bits, if lit, its radiusOf as a half float
    uint red_green;    // half floats; for first hits, owner and tile
    uint blue_opacity; // a half float, high bits: the opacity along the ray; for first hits, material and opacity
    uint normal;       // normalWord in render space
};
// Maximum number of waiting Gaussians of a ray, so that the buffer for 2^19 paths fits in 128 MiB.
#define WAITING_GAUSSIANS 10u
// Per path: the first Gaussians behind those that have been composited.
struct WaitingGaussians {
    uint count;
    float last_t; // of the last Gaussian composited; 0 before the first
    uint last_instance;
    uint last_gaussian;
    WaitingGaussian each[WAITING_GAUSSIANS];
};

// The boxes of a cull group: rays are tested against a box before they are intersected with the instance inside.
// Coordinates are quantized to steps so that a box takes two words: on lavapipe, loads dominate the cost of culling.
struct CullBoxes {
    vec4 row_x; // render space to steps along the axes of the boxes: a similarity; w: translation
    vec4 row_y;
    vec4 row_z;
    uvec4 instances;                  // x: mask of the boxes in use
    uvec4 boxes[CULL_INSTANCES / 2u]; // x, y: centre and half edges of an even box; z, w: of the next one
};
// Bits per coordinate in such a word, x lowest.
#define CULL_BITS 10u
#define CULL_STEPS 1023u
// Bound of the rounding error, relative to the largest coordinate of a ray origin or a box: a few times 2^-24 each for
// the transforms into the frame of the boxes and into that of a tile, and for the products there.
#define CULL_ROUNDING 2e-6f
// Capacity of the culled lists of a group, in entries per lane: two instances for each of the SHADOW_RAYS_PER_PATH
// shadow rays of a path. An instance whose list does not fit is intersected with all rays.
#define CULLED_ENTRIES 16u

// The state of a path between two dispatches.
struct PathState {
    vec3 origin;
    float self_t; // self-intersection distance: nearer hits on the surface that the ray left are ignored
    vec3 direction;
    float pdf; // of the direction, over solid angle; 0: a delta distribution (mirrors, glass, camera)
    vec3 throughput;
    uint target;      // photons from a light: the owner they are aimed at; for a shape, its number in the high bits
    vec3 self_normal; // normal of the surface that the ray left
    uint bits;        // PATH_*
};
#define PATH_VECTORS 4
#define PATH_BOUNCE_MASK 0xFFu
#define PATH_DEFERRED_SHIFT 8u // number of deferred rays of the pixel, 0 to MAX_DEFERRED
#define PATH_DEFERRED_MASK 0xFu
// the path last scattered, other than at mirrors and glass, on a surface that gathers photons
#define PATH_DIFFUSED 0x1000u
#define PATH_INSIDE 0x2000u  // has entered glass of a scan and not left it
#define PATH_CAUSTIC 0x4000u // emission that it hits is already in the photon map
#define PATH_OWNER_SHIFT 24u // owner of the surface it left, NO_OWNER for camera rays
#define NO_OWNER 254u
#define PHOTON_SHAPE_SHIFT 8u // in a photon's target

// Largest number of deferred rays of a pixel: the second rays of reflection and refraction pairs, traced later.
#define MAX_DEFERRED 2u

// Data that the program surface stores for a hit on splats, in addition to the words of hit_texels
// (shaders/trace/surface_interaction.glsl).
struct StoredSurface {
    vec3 normal; // facing the viewer
    uint bits;   // material and SURFACE_*
    vec3 albedo; // linear
    float t;     // along the ray, of the blended surface
};
#define SURFACE_VECTORS 2
#define SURFACE_MATERIAL_MASK 0xFFFFFFu
#define SURFACE_SELF_REACH_SHIFT                                                                                       \
    24u // largest self-intersection distance of rays that leave the surface (shaders/trace/offset.glsl)
#define SURFACE_SELF_REACH_MASK 31u
#define SURFACE_CASTS 0x20000000u // casts caustics: photons are traced through it
#define SURFACE_SIDED 0x40000000u // normals are oriented, so inside and outside are known
#define SURFACE_BACK 0x80000000u  // seen from the inside

// A surface point that needs direct light: the input of next event estimation.
struct DirectLightQuery {
    vec3 position;
    float radius;  // of the SurfaceInteraction (shaders/trace/surface_interaction.glsl)
    vec3 normal;   // facing the viewer
    uint material; // and the surface's SURFACE_SELF_REACH bits
    vec3 albedo;
    uint owner;
    vec3 throughput;
    uint bounce; // of the path
    vec3 view;   // direction to the viewer
    float side;  // -1 if normal is the stored normal flipped, else 1
};
#define LIGHT_QUERY_VECTORS 5

// A shadow ray of the megakernel that instances may occlude, with its contribution if nothing occludes it.
struct ShadowRay {
    vec3 origin;
    float self_t; // self-intersection distance, as in PathState
    vec3 direction;
    float t_max; // just short of the light; negative: occluded
    vec3 self_normal;
    uint owner;       // owner of the surface that the ray left
    vec3 light;       // contribution to the pixel
    uint scatterings; // number of scatterings of that light on its way to the eye
};
#define SHADOW_RAY_VECTORS 4

// Layers of the film, one vector per pixel each: sums over the samples of the current batch. Films of more samples than
// a batch have a second set of layers, from FILM_LAYERS on: sums over the earlier batches, defined once there is an
// earlier batch.
#define LAYER_DIRECT 0u   // light scattered at most once; w: coverage by the scene
#define LAYER_INDIRECT 1u // w: luminance of the current sample; 0 in earlier batches
// w: part of the sum of squared deviations of the luminance from its mean (luminance_moments.h), due to the samples of
// the batch before the current one, or to the earlier batches
#define LAYER_CAUSTIC 2u
#define LAYER_ALBEDO 3u // w: mean luminance of all samples before the current one; 0 in earlier batches
#define FILM_LAYERS 4u
// Samples of a batch, the square root of kMaxSpp: a sum of 256 similar terms keeps 16 of the 24 bits of each, and so
// does a sum of 256 batches. A single sum of 65,536 samples would keep 8 bits, an error of up to 0.2%.
#define FILM_BATCH 256u

// first_hits, per pixel: normal and t (negative: a miss); as bits, splat or shape, owner with the tile above it
// (HIT_TILE_SHIFT), and material; view dependence of the reflection, 0 to 1.
#define FIRST_HIT_VECTORS 2u

struct PushParams {
    uint sample_index;
    uint first_light_sample; // number of the first light sample whose shadow rays this pass traces
    uint step;               // STEP_*
    uint list;               // LIST_* or a culled list: the program's input
};

#define STEP_CENTER 1u       // rays go through pixel centres
#define STEP_FIRST_HIT 2u    // rays for the first-hit AOVs: surroundings are invisible
#define STEP_RESET 4u        // prepare: start of a sample
#define STEP_QUEUE_ONE 8u    // rays are read from queue 1 and appended to queue 0
#define STEP_PREVIEW 16u     // sample lights at their centres, and trace shadow rays only to the first light: no noise
#define STEP_LIST 32u        // prepare: the list is complete
#define STEP_HITS 64u        // prepare: empty the hit list for the next instance
#define STEP_LAST 128u       // intersect_shadow_ray, composite_gaussians: this is the last instance
#define STEP_PIXEL_LIST 256u // rays go through the pixels of the pixel list, one per lane
#define STEP_CULLED 512u     // prepare: the entries of the culled lists have been counted
#define STEP_FIRST 1024u     // composite_gaussians, gather_gaussians: this is the first instance
// composite_gaussians: continue rays that lavapipe's limit ended in the run before; or rays of a list
#define STEP_RESUME 2048u
#define STEP_FINAL 4096u       // composite_gaussians: the last run of this instance; blend_gaussians: the last round
#define STEP_FIRST_HITS 8192u  // gather_gaussians: for first hits instead of light
#define STEP_COUNT_HITS 16384u // intersect_closest: count the hits on each pooled tile
// megakernel with one bounce: some paths have scattered only once, so their light may be direct
#define STEP_DIRECT 32768u

// hit_texels for pooled tiles, until the program surface has read them: above the owner, the tile's place among the
// tiles of its program.
#define HIT_PLACE_SHIFT 8u

// An entry of LIST_SHADOW_RAYS: the path, and in the bits above it the number of its light sample.
#define SHADOW_RAY_LIGHT_SHIFT 27u
// Capacity of LIST_SHADOW_RAYS, in shadow rays per path. More light samples take several passes.
#define SHADOW_RAYS_PER_PATH 8u

#ifdef __cplusplus
POINTRT_ROWS(FrameParams, 14 + sizeof(EnvironmentFrame) / 16 + sizeof(CausticFrame) / 16 + HELD_SHAPES * SHAPE_VECTORS);
POINTRT_ROW(FrameParams, sky_up);
POINTRT_ROW(FrameParams, width);
POINTRT_ROW(FrameParams, instances_low);
POINTRT_ROW(FrameParams, environment);
POINTRT_ROW(FrameParams, held_shapes);
POINTRT_ROWS(RayList, 2);
static_assert(LISTS == LIST_CULLED + CULL_INSTANCES);
POINTRT_ROWS(Control, 5 + 2 * LISTS);
POINTRT_ROW(Control, tile_groups);
POINTRT_ROW(Control, queued);
POINTRT_ROW(Control, lists);
static_assert(sizeof(WaitingGaussians) == 256);
POINTRT_ROWS(CullBoxes, 4 + CULL_INSTANCES / 2);
POINTRT_ROWS(PathState, PATH_VECTORS);
POINTRT_ROW(PathState, self_normal);
POINTRT_ROWS(StoredSurface, SURFACE_VECTORS);
POINTRT_ROWS(DirectLightQuery, LIGHT_QUERY_VECTORS);
POINTRT_ROW(DirectLightQuery, view);
POINTRT_ROWS(ShadowRay, SHADOW_RAY_VECTORS);
POINTRT_ROWS(PushParams, 1);
} // namespace pointrt::gpu
#endif

#endif

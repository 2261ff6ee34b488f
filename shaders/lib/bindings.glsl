// SPDX-License-Identifier: Apache-2.0
// All buffers of a frame's programs. See instance_bindings.glsl for those of an instance, and for the fastest way to
// read each kind of buffer.
#ifndef POINTRT_SHADERS_BINDINGS_GLSL
#define POINTRT_SHADERS_BINDINGS_GLSL
#include "shaders/lib/instance_bindings.glsl"
#include "shaders/lib/features.glsl"

// The scene.
layout(binding = BINDING_MATERIALS) uniform usamplerBuffer material_texels;
layout(binding = BINDING_SHAPES) uniform usamplerBuffer shape_texels;
layout(binding = BINDING_LIGHTS) uniform usamplerBuffer light_texels;
layout(binding = BINDING_GGX_ALBEDO) uniform samplerBuffer ggx_albedo; // runtime/device_scene/ggx_albedo.h
// runtime/device_scene/environment.h
layout(binding = BINDING_ENVIRONMENT_TEXELS) uniform samplerBuffer environment_texels;
layout(binding = BINDING_ENVIRONMENT_CDF) uniform samplerBuffer environment_cdf;
layout(binding = BINDING_PHOTON_TEXELS) uniform usamplerBuffer photon_texels;
layout(binding = BINDING_PHOTON_BUCKETS) uniform usamplerBuffer photon_buckets;

// The frame.
layout(std140, binding = BINDING_PARAMS) uniform ParamsBuffer { FrameParams params; };
layout(std430, binding = BINDING_CONTROL) buffer ControlBuffer { Control control; };
// In this order: two ray queues (the first initially holds tiles), LIST_DIRECT_LIGHT, the hit list, LIST_INSTANCE_RAYS,
// and LIST_SHADOW_RAYS with SHADOW_RAYS_PER_PATH entries per path; with instance culling also the cull masks of a
// list's entries, with room for those of LIST_SHADOW_RAYS, and the culled lists, CULLED_ENTRIES per path
layout(std430, binding = BINDING_QUEUES) buffer QueueBuffer { uint queues[]; };
layout(std430, binding = BINDING_PATHS) buffer PathBuffer { PathState paths[]; };
// splats, as in TraceHit: t as bits, cell, disc (an index into the listed splats), owner; after the program surface: t,
// offset radius as bits, splat, owner with the tile above it (HIT_TILE_SHIFT). Shapes: t, 0, shape, OWNER_SHAPES
layout(rgba32ui, binding = BINDING_HITS) uniform uimageBuffer hit_texels;
layout(std430, binding = BINDING_LIGHT_QUERIES) buffer LightQueryBuffer { DirectLightQuery light_queries[]; };
layout(std430, binding = BINDING_FILM) buffer FilmBuffer { vec4 film[]; };
layout(std430, binding = BINDING_FIRST_HITS) buffer FirstHitBuffer { vec4 first_hits[]; }; // per pixel
layout(binding = BINDING_PATHS_TEXELS) uniform usamplerBuffer path_texels; // views paths
layout(binding = BINDING_QUEUES_TEXELS) uniform usamplerBuffer queue_words; // views queues
// per tile: the free distance of its rays
layout(std430, binding = BINDING_BEAMS) buffer BeamBuffer { float beams[]; };
layout(binding = BINDING_BEAMS_TEXELS) uniform samplerBuffer beam_texels; // views beams
layout(std430, binding = BINDING_SURFACES) buffer SurfaceBuffer { StoredSurface surfaces[]; };
// per path: bit i set if light sample i is occluded
layout(std430, binding = BINDING_LIGHT_MASKS) buffer ShadowBuffer { uint light_masks[]; };
layout(std430, binding = BINDING_DEFERRED) buffer DeferredBuffer { PathState deferred[]; }; // MAX_DEFERRED per pixel
// per path; shares memory with light_queries: no kernel form uses both at a time
layout(std430, binding = BINDING_SHADOW_RAYS) buffer ShadowRayBuffer { ShadowRay shadow_rays[]; };
layout(binding = BINDING_SHADOW_RAYS_TEXELS) uniform usamplerBuffer shadow_ray_texels;
layout(std430, binding = BINDING_PHOTONS) buffer PhotonBuffer { Photon photons[]; }; // photons in flight
layout(binding = BINDING_SURFACES_TEXELS) uniform usamplerBuffer surface_texels; // views surfaces
layout(binding = BINDING_LIGHT_QUERIES_TEXELS) uniform usamplerBuffer light_query_texels; // views light_queries
// pixels of the picture, x | y << 16, traced with STEP_PIXEL_LIST
layout(binding = BINDING_PIXEL_LIST) uniform usamplerBuffer pixel_list_words;
layout(std140, binding = BINDING_CULL_BOXES) uniform CullBuffer { CullBoxes cull; };
// per path: the linear light that Gaussians add in front of its hit; w: the share that passes. One vector in scenes
// without Gaussians
layout(std430, binding = BINDING_GAUSSIAN_LIGHT) buffer GaussianLightBuffer { GaussianLight gaussian_light[]; };
// per path; only one if all Gaussians of the scene are in one instance
layout(std430, binding = BINDING_WAITING_GAUSSIANS) buffer WaitingGaussianBuffer {
    WaitingGaussians waiting_gaussians[];
};
layout(push_constant) uniform Push { PushParams push; };

#define loadPhoton(photon, member) uintBitsToFloat(texelFetch(photon_texels, int(photon) * PHOTON_VECTORS + (member)))
#define loadPhotonWord(i) texelFetch(photon_buckets, int(i)).x
#define loadPhotonLevel(i) params.caustics.levels[i]
#define loadGgxAlbedo(i) texelFetch(ggx_albedo, int(i)).xy
#define loadEnvironmentTexel(i) texelFetch(environment_texels, int(i))
#define loadEnvironmentCdf(i) texelFetch(environment_cdf, int(i)).x
#define PATH_ORIGIN 0
#define PATH_DIRECTION 1
#define PATH_THROUGHPUT 2
#define PATH_SELF_NORMAL 3
#define loadPathTexel(path, member) texelFetch(path_texels, int(path) * PATH_VECTORS + (member))
#define loadQueue(i) texelFetch(queue_words, int(i)).x
#define loadBeam(tile) texelFetch(beam_texels, int(tile)).x
#define loadSurfaceTexel(path, member) texelFetch(surface_texels, int(path) * SURFACE_VECTORS + (member))
#define loadLightQueryTexel(path, member) texelFetch(light_query_texels, int(path) * LIGHT_QUERY_VECTORS + (member))
#define loadShadowTexel(path, member) texelFetch(shadow_ray_texels, int(path) * SHADOW_RAY_VECTORS + (member))
#define loadListedPixel(i) texelFetch(pixel_list_words, int(i)).x
#define loadHit(path) imageLoad(hit_texels, int(path))

// Texels are fetched as integers: fetched as floats, integers in them would be denormals, which drivers may flush to 0.
float asFloat(uint word) { return uintBitsToFloat(word); }
vec3 asVector(uvec4 words) { return uintBitsToFloat(words.xyz); }
vec4 materialVector(int i) { return uintBitsToFloat(texelFetch(material_texels, i)); }
vec4 shapeVector(int i) { return uintBitsToFloat(texelFetch(shape_texels, i)); }
vec4 lightVector(int i) { return uintBitsToFloat(texelFetch(light_texels, i)); }

Material loadMaterial(uint index) {
    int i = int(index) * MATERIAL_VECTORS;
    return Material(materialVector(i), materialVector(i + 1), materialVector(i + 2), materialVector(i + 3),
                    materialVector(i + 4));
}

#define loadShape(i) fetchShape(i)
Shape fetchShape(uint index) {
    int i = int(index) * SHAPE_VECTORS;
    return Shape(shapeVector(i), shapeVector(i + 1), shapeVector(i + 2), texelFetch(shape_texels, i + 3));
}

// A shape of a scene with at most HELD_SHAPES; i is a constant in unrolled loops.
Shape heldShape(uint i) {
    Shape shape = params.held_shapes[i];
    shape.kind.x = kShapeKinds >> (SHAPE_COUNT_BITS + SHAPE_KIND_BITS * i) & (1u << SHAPE_KIND_BITS) - 1u;
    return shape;
}

Light loadLight(uint index) {
    int i = int(index) * LIGHT_VECTORS;
    return Light(lightVector(i), lightVector(i + 1), lightVector(i + 2), lightVector(i + 3), lightVector(i + 4));
}

bool hasOption(uint option) { return (params.options & option) != 0u; }
bool hasStep(uint bit) { return (push.step & bit) != 0u; }
// Lanes of a sample: the band in tiles; tiles at its borders are padded.
uint tilesAcross() { return (params.width + TILE_SIDE - 1u) / TILE_SIDE; }
uint bandTiles() { return tilesAcross() * ((params.rows + TILE_SIDE - 1u) / TILE_SIDE); }
uint bandLanes() { return bandTiles() * TILE_PIXELS; }
uint rayQueueStart(bool second) { return second ? bandLanes() : 0u; }
uint lightQueueStart() { return 2u * bandLanes(); }
uint hitListStart() { return 3u * bandLanes(); }
uint instanceRayListStart() { return 4u * bandLanes(); }
uint shadowRayListStart() { return 5u * bandLanes(); }
uint cullMaskStart() { return (5u + SHADOW_RAYS_PER_PATH) * bandLanes(); }
uint culledListStart() { return (5u + 2u * SHADOW_RAYS_PER_PATH) * bandLanes(); }
uint culledListEnd() { return culledListStart() + CULLED_ENTRIES * bandLanes(); }

// For lists that programs append to.
uint listStart(uint list) {
    return list == LIST_DIRECT_LIGHT    ? lightQueueStart()
           : list == LIST_INSTANCE_RAYS ? instanceRayListStart()
                                        : shadowRayListStart();
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Every buffer, once. What is looked up at random is read through texel buffers: on lavapipe those are hardware
// gathers, three times as fast as storage buffers, and they may hold 2 GiB where storage buffers end at 128 MiB. More
// than that, of an instance's, is in further pages in a set of their own, for programs built with PAGED (pages.glsl).
// What the loops of traversal and blending read are images of buffers: lavapipe makes those loads part of a program,
// where fetches of texels are calls, for which all that is alive goes through memory.
#ifndef POINTRT_SHADERS_BINDINGS_GLSL
#define POINTRT_SHADERS_BINDINGS_GLSL
#include "shaders/shared/params.h"
#include "shaders/frame/features.glsl"
#include "pointrt/pro_index_layout.h"
#include "pointrt/pro_layout.h"

// One instance's.
layout(set = 0, binding = 1, r32ui) uniform readonly uimageBuffer brick_words;
layout(set = 0, binding = 2, rgba32ui) uniform readonly uimageBuffer list_words;
layout(set = 0, binding = 3, rgba32ui) uniform readonly uimageBuffer splat_words;
layout(set = 0, binding = 4, r32ui) uniform readonly uimageBuffer grid_words;
layout(set = 0, binding = 14) uniform usamplerBuffer cell_words;
layout(set = 0, binding = 15, rgba32ui) uniform readonly uimageBuffer disc_words;
layout(set = 0, binding = 16) uniform usamplerBuffer blend_range_words;
layout(set = 0, binding = 21, r32ui) uniform readonly uimageBuffer slab_words;
layout(std140, set = 0, binding = 22) uniform InstanceBuffer { InstanceParams instance; };

// The scene's.
layout(set = 0, binding = 5) uniform usamplerBuffer material_texels;
layout(set = 0, binding = 23) uniform usamplerBuffer shape_texels;
layout(set = 0, binding = 24) uniform usamplerBuffer light_texels;
layout(set = 0, binding = 28) uniform samplerBuffer ggx_albedo; // runtime/device_scene/ggx_albedo.h
layout(set = 0, binding = 29) uniform samplerBuffer environment_texels; // runtime/device_scene/environment.h
layout(set = 0, binding = 30) uniform samplerBuffer environment_cdf;
layout(set = 0, binding = 31) uniform usamplerBuffer photon_texels;
layout(set = 0, binding = 32) uniform usamplerBuffer photon_buckets;

// The frame's.
layout(std140, set = 0, binding = 6) uniform ParamsBuffer { FrameParams params; };
layout(std430, set = 0, binding = 7) buffer ControlBuffer { Control control; };
// two of rays (the first one holds tiles at first), one of light queries, one of hits, one of rays for instances
layout(std430, set = 0, binding = 8) buffer QueueBuffer { uint queues[]; };
layout(std430, set = 0, binding = 9) buffer PathBuffer { PathState paths[]; };
// TraceHit: t as bits, cell, disc, which is its place in the lists too, owner; of shapes: t, 0, shape, OWNER_SHAPES
layout(rgba32ui, set = 0, binding = 10) uniform uimageBuffer hit_texels;
layout(std430, set = 0, binding = 11) buffer LightQueryBuffer { DirectLightQuery light_queries[]; };
layout(std430, set = 0, binding = 12) buffer FilmBuffer { vec4 film[]; };
layout(std430, set = 0, binding = 13) buffer FirstHitBuffer { vec4 first_hits[]; }; // FIRST_HIT_VECTORS a pixel
layout(set = 0, binding = 17) uniform usamplerBuffer path_texels; // of paths
layout(set = 0, binding = 18) uniform usamplerBuffer queue_words; // of queues
layout(std430, set = 0, binding = 19) buffer BeamBuffer { float beams[]; }; // of each tile: its rays' free distance
layout(set = 0, binding = 20) uniform samplerBuffer beam_texels; // of beams
layout(std430, set = 0, binding = 25) buffer SurfaceBuffer { SurfacePoint surfaces[]; };
layout(std430, set = 0, binding = 26) buffer ShadowBuffer { uint light_masks[]; }; // bit l: light l does not reach it
layout(std430, set = 0, binding = 27) buffer DeferredBuffer { PathState deferred[]; }; // MAX_DEFERRED a pixel
layout(std430, set = 0, binding = 33) buffer PhotonBuffer { Photon photons[]; }; // being traced
layout(set = 0, binding = 34) uniform usamplerBuffer surface_texels; // of surfaces
layout(set = 0, binding = 35) uniform usamplerBuffer light_query_texels; // of light_queries
layout(push_constant) uniform Push { PushParams push; };

#ifdef PAGED // the same loads
#include "shaders/frame/pages.glsl"
#else
#define loadBrickWord(i) imageLoad(brick_words, int(i)).x
#define loadCell(i) texelFetch(cell_words, int(i)).xy
#define loadSlab(i) imageLoad(slab_words, int(i)).x
#define loadDiscs(i) imageLoad(disc_words, int(i))
#define loadBlendRange(i) texelFetch(blend_range_words, int(i)).xy
// four to a texel: drivers count texels, often no more than 2^27
#define loadListedTexel(i) imageLoad(list_words, int(i))
#define loadListed(i) loadListedTexel((i) >> 2)[(i) & 3u]
#define loadSplat(i) imageLoad(splat_words, int(i))
#endif
#define loadGrid(i) imageLoad(grid_words, int(i)).x
#define loadPhoton(photon, member) uintBitsToFloat(texelFetch(photon_texels, int(photon) * PHOTON_VECTORS + (member)))
#define loadPhotonWord(i) texelFetch(photon_buckets, int(i)).x
#define loadPhotonLevel(i) params.caustics.levels[i]
#define loadGgxAlbedo(i) texelFetch(ggx_albedo, int(i)).xy
#define loadEnvironmentTexel(i) texelFetch(environment_texels, int(i))
#define loadEnvironmentCdf(i) texelFetch(environment_cdf, int(i)).x
#define PATH_ORIGIN 0
#define PATH_DIRECTION 1
#define PATH_THROUGHPUT 2
#define PATH_LEFT_NORMAL 3
#define loadPathTexel(path, member) uintBitsToFloat(texelFetch(path_texels, int(path) * 4 + (member)))
#define loadQueue(i) texelFetch(queue_words, int(i)).x
#define loadBeam(tile) texelFetch(beam_texels, int(tile)).x
#define loadSurfaceTexel(path, member) uintBitsToFloat(texelFetch(surface_texels, int(path) * SURFACE_VECTORS + (member)))
#define loadLightQueryTexel(path, member) \
    uintBitsToFloat(texelFetch(light_query_texels, int(path) * LIGHT_QUERY_VECTORS + (member)))
#define loadHit(path) imageLoad(hit_texels, int(path))

// Floats are fetched as bits: what they hold as bits would be small floats, which drivers may take for 0.
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

Light loadLight(uint index) {
    int i = int(index) * LIGHT_VECTORS;
    return Light(lightVector(i), lightVector(i + 1), lightVector(i + 2), lightVector(i + 3), lightVector(i + 4));
}

bool hasOption(uint option) { return (params.scene.y & option) != 0u; }
// A number below 2^31 from a uniform block, where a loop's end or an if hangs on it. Else lavapipe takes it for a constant
// and makes the program anew, for milliseconds, at each dispatch.
uint ofLane(uint number) { return min(number, 0x80000000u | gl_LocalInvocationID.x); }
bool hasStep(uint bit) { return (push.step.w & bit) != 0u; }
// Lanes of a sample: the band in tiles, the last ones padded.
uint tilesAcross() { return (params.image.x + TILE_SIDE - 1u) / TILE_SIDE; }
uint bandTiles() { return tilesAcross() * ((params.image.w + TILE_SIDE - 1u) / TILE_SIDE); }
uint bandLanes() { return bandTiles() * TILE_PIXELS; }
uint rayQueueStart(bool second) { return second ? bandLanes() : 0u; }
uint lightQueueStart() { return 2u * bandLanes(); }
uint hitListStart() { return 3u * bandLanes(); }
uint askedListStart() { return 4u * bandLanes(); }

#endif

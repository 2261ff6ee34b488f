// SPDX-License-Identifier: Apache-2.0
// The buffers of one instance. Random reads go through texel buffers: on lavapipe these reads are hardware gathers,
// three times as fast as reads of storage buffers, and texel buffers may hold 2 GiB, while storage buffers end at 128
// MiB. Larger buffers have further pages in a separate descriptor set, for programs built with PAGED (pages.glsl). The
// loops of traversal and blending read image buffers: lavapipe inlines image loads, while texel fetches are calls that
// spill all live registers. GPUs read buffers of one page as storage buffers, with plain cached loads instead of the
// texture path that texels take. POOLED: programs for the tiles in a block, in which each lane chooses its tile
// (pool.glsl).
#ifndef POINTRT_SHADERS_INSTANCE_BINDINGS_GLSL
#define POINTRT_SHADERS_INSTANCE_BINDINGS_GLSL
#include "shaders/shared/bindings.h"
#include "shaders/shared/params.h"
#include "shaders/shared/spec_constants.h"
#include "pointrt/pro_index_layout.h"
#include "pointrt/pro_layout.h"

layout(binding = BINDING_BRICK_WORDS, r32ui) uniform readonly uimageBuffer brick_words;
layout(binding = BINDING_LISTED) uniform usamplerBuffer listed_words;
layout(binding = BINDING_SPLATS, rgba32ui) uniform readonly uimageBuffer splat_words;
layout(binding = BINDING_GRID_WORDS, r32ui) uniform readonly uimageBuffer grid_words;
layout(binding = BINDING_CELLS) uniform usamplerBuffer cell_words;
layout(binding = BINDING_NEAR, rgba32ui) uniform readonly uimageBuffer near_words;
layout(binding = BINDING_BLENDING, r32ui) uniform readonly uimageBuffer blending_words;
layout(binding = BINDING_SLABS, r32ui) uniform readonly uimageBuffer slab_words;
layout(binding = BINDING_NOISE) uniform usamplerBuffer noise_words; // 16 bytes per texel: one page holds 2^31 splats
layout(std430, binding = BINDING_BRICK_STORED) restrict readonly buffer BrickBuffer { uint brick_array[]; };
layout(std430, binding = BINDING_LISTED_STORED) restrict readonly buffer ListedBuffer { uint listed_array[]; };
layout(std430, binding = BINDING_SPLAT_STORED) restrict readonly buffer SplatBuffer { uvec4 splat_array[]; };
layout(std430, binding = BINDING_GRID_STORED) restrict readonly buffer GridBuffer { uint grid_array[]; };
layout(std430, binding = BINDING_CELL_STORED) restrict readonly buffer CellBuffer { uvec4 cell_array[]; };
layout(std430, binding = BINDING_NEAR_STORED) restrict readonly buffer NearBuffer { uvec4 near_array[]; };
layout(std430, binding = BINDING_BLENDING_STORED) restrict readonly buffer BlendingBuffer { uint blending_array[]; };
layout(std430, binding = BINDING_SLAB_STORED) restrict readonly buffer SlabBuffer { uint slab_array[]; };
layout(constant_id = SPEC_READS_STORAGE) const bool kReadsStorage = false;

#define LOAD_IMAGE(array, texels, i) (kReadsStorage ? array[i] : imageLoad(texels, int(i)))
#define LOAD_IMAGE_WORD(array, texels, i) (kReadsStorage ? array[i] : imageLoad(texels, int(i)).x)
#define LOAD_TEXEL(array, texels, i) (kReadsStorage ? array[i] : texelFetch(texels, int(i)))

#ifdef POOLED
layout(std140, binding = BINDING_INSTANCE) uniform InstanceBuffer { InstanceParams first_instance; };
#include "shaders/lib/pool.glsl"
#else
layout(std140, binding = BINDING_INSTANCE) uniform InstanceBuffer { InstanceParams instance; };
#define loadClipPlane(i) instance.clip_planes[i]
#define loadColorRange(i) instance.color_range[i]
#define loadGrid(i) LOAD_IMAGE_WORD(grid_array, grid_words, i)
#define loadNoise(i) (texelFetch(noise_words, int((i) >> 4))[(i) >> 2 & 3u] >> (8u * ((i) & 3u)) & 0xFFu)
#endif

#ifdef PAGED
#include "shaders/lib/pages.glsl"
#elif !defined(POOLED)
#define loadBrickWord(i) LOAD_IMAGE_WORD(brick_array, brick_words, i)
#define loadCell(i) LOAD_TEXEL(cell_array, cell_words, i)
#define loadSlab(i) LOAD_IMAGE_WORD(slab_array, slab_words, i)
#define loadNearPair(i) LOAD_IMAGE(near_array, near_words, i)
#define loadBlending(i) LOAD_IMAGE_WORD(blending_array, blending_words, i)
#define loadListedPair(i) \
    (kReadsStorage ? uvec2(listed_array[2u * (i)], listed_array[2u * (i) + 1u]) : texelFetch(listed_words, int(i)).xy)
#define loadListed(i) \
    (kReadsStorage ? listed_array[i] : texelFetch(listed_words, int((i) >> 1))[(i) & 1u])
#define loadSplat(i) LOAD_IMAGE(splat_array, splat_words, i)
#endif

// Wraps a number below 2^31 from a uniform block that controls a loop or a branch. Without this, lavapipe treats the
// number as a constant and recompiles the program at each dispatch, which takes milliseconds.
uint ofLane(uint number) { return min(number, 0x80000000u | gl_LocalInvocationID.x); }

#endif

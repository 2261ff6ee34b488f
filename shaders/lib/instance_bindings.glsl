// SPDX-License-Identifier: Apache-2.0
// The buffers of one instance. Random reads go through texel buffers: on lavapipe those are hardware gathers, three
// times as fast as storage buffers, and they may hold 2 GiB, while storage buffers end at 128 MiB. Larger buffers have
// further pages in a descriptor set of their own, for programs built with PAGED (pages.glsl). The loops of traversal
// and blending read image buffers: lavapipe inlines image loads, while texel fetches are calls that spill all live
// registers. POOLED: programs for the tiles in a block, each lane of which chooses its tile (pool.glsl).
#ifndef POINTRT_SHADERS_INSTANCE_BINDINGS_GLSL
#define POINTRT_SHADERS_INSTANCE_BINDINGS_GLSL
#include "shaders/shared/bindings.h"
#include "shaders/shared/params.h"
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
#ifdef POOLED
layout(std140, binding = BINDING_INSTANCE) uniform InstanceBuffer { InstanceParams first_instance; };
#include "shaders/lib/pool.glsl"
#else
layout(std140, binding = BINDING_INSTANCE) uniform InstanceBuffer { InstanceParams instance; };
#define loadClipPlane(i) instance.clip_planes[i]
#define loadColorRange(i) instance.color_range[i]
#define loadGrid(i) imageLoad(grid_words, int(i)).x
#define loadNoise(i) (texelFetch(noise_words, int((i) >> 4))[(i) >> 2 & 3u] >> (8u * ((i) & 3u)) & 0xFFu)
#endif

#ifdef PAGED
#include "shaders/lib/pages.glsl"
#elif !defined(POOLED)
#define loadBrickWord(i) imageLoad(brick_words, int(i)).x
#define loadCell(i) texelFetch(cell_words, int(i))
#define loadSlab(i) imageLoad(slab_words, int(i)).x
#define loadNearPair(i) imageLoad(near_words, int(i))
#define loadBlending(i) imageLoad(blending_words, int(i)).x
#define loadListedPair(i) texelFetch(listed_words, int(i)).xy
#define loadListed(i) loadListedPair((i) >> 1)[(i) & 1u]
#define loadSplat(i) imageLoad(splat_words, int(i))
#endif

// A number below 2^31 from a uniform block that controls a loop or a branch. Without this lavapipe treats it as a
// constant and recompiles the program at each dispatch, which takes milliseconds.
uint ofLane(uint number) { return min(number, 0x80000000u | gl_LocalInvocationID.x); }

#endif

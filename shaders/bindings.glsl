// SPDX-License-Identifier: Apache-2.0
// Every buffer, once. Octree data is read through texel buffers: on lavapipe those are hardware gathers, three times
// as fast as storage buffers, and they may hold 2 GiB where storage buffers end at 128 MiB.
#include "params.h"
#include "brick_layout.h"
#include "pointrt/pro_layout.h"

layout(set = 0, binding = 1) uniform usamplerBuffer brick_words;
layout(set = 0, binding = 2) uniform usamplerBuffer list_words;
layout(set = 0, binding = 3) uniform usamplerBuffer splat_words;
layout(set = 0, binding = 4) uniform usamplerBuffer grid_words;
layout(set = 0, binding = 5) uniform samplerBuffer material_rows;
layout(std430, set = 0, binding = 6) readonly buffer ParamsBuffer { FrameParams params; };
layout(std430, set = 0, binding = 7) buffer ControlBuffer { Control control; };
// two of rays (the first one holds tiles at first), one of lit points
layout(std430, set = 0, binding = 8) buffer QueueBuffer { uint queues[]; };
layout(std430, set = 0, binding = 9) buffer PathBuffer { PathState paths[]; };
// TraceHit: t as bits, cell, near splat and its place in the lists
layout(rgba32ui, set = 0, binding = 10) uniform uimageBuffer hit_texels;
layout(std430, set = 0, binding = 11) buffer LitBuffer { LitPoint lit_points[]; };
layout(std430, set = 0, binding = 12) buffer FilmBuffer { vec4 film[]; };
layout(std430, set = 0, binding = 13) buffer FirstHitBuffer { vec4 first_hits[]; }; // normal, t (negative: none)
layout(set = 0, binding = 14) uniform usamplerBuffer cell_words;
layout(set = 0, binding = 15) uniform usamplerBuffer near_words;
layout(set = 0, binding = 16) uniform usamplerBuffer blend_range_words;
layout(set = 0, binding = 17) uniform samplerBuffer path_texels; // of paths
layout(set = 0, binding = 18) uniform usamplerBuffer queue_words; // of queues
layout(std430, set = 0, binding = 19) buffer BeamBuffer { float beams[]; }; // of each tile: free distance from the eye
layout(set = 0, binding = 20) uniform samplerBuffer beam_texels; // of beams
layout(set = 0, binding = 21) uniform usamplerBuffer slab_words;
layout(push_constant) uniform Push { PushParams push; };

#define loadBrickWord(i) texelFetch(brick_words, int(i)).x
#define loadCell(i) texelFetch(cell_words, int(i)).xy
#define loadSlab(i) texelFetch(slab_words, int(i)).x
#define loadNear(i) texelFetch(near_words, int(i))
#define loadBlendRange(i) texelFetch(blend_range_words, int(i)).xy
// four to a texel: drivers count texels, often no more than 2^27
#define loadListed(i) texelFetch(list_words, int((i) >> 2))[(i) & 3u]
#define loadSplat(i) texelFetch(splat_words, int(i))
#define loadGrid(i) texelFetch(grid_words, int(i)).x
#define PATH_ORIGIN 0
#define PATH_DIRECTION 1
#define PATH_LEFT_NORMAL 3
#define loadPathTexel(path, member) texelFetch(path_texels, int(path) * 4 + (member))
#define loadQueue(i) texelFetch(queue_words, int(i)).x
#define loadBeam(tile) texelFetch(beam_texels, int(tile)).x
#define loadHit(path) imageLoad(hit_texels, int(path))
#define loadMaterial(row, quarter) texelFetch(material_rows, int(row) * 4 + (quarter))

bool hasOption(uint option) { return (params.scene.y & option) != 0u; }
bool hasStep(uint bit) { return (push.step.w & bit) != 0u; }
// Lanes of a sample: the band in tiles, the last ones padded.
uint tilesAcross() { return (params.image.x + TILE_SIDE - 1u) / TILE_SIDE; }
uint bandTiles() { return tilesAcross() * ((params.image.w + TILE_SIDE - 1u) / TILE_SIDE); }
uint bandLanes() { return bandTiles() * TILE_PIXELS; }
uint rayQueueStart(bool second) { return second ? bandLanes() : 0u; }
uint litQueueStart() { return 2u * bandLanes(); }

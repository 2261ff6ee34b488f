// SPDX-License-Identifier: Apache-2.0
// Shapes and instances as the shaders read them (lights: light_layout.h, materials: materials.h). Valid in C++ and
// GLSL. Lengths are in render units, the frame shared by all instances and shapes
// (runtime/device_scene/render_space.h).
#ifndef POINTRT_SHADERS_SCENE_LAYOUT_H
#define POINTRT_SHADERS_SCENE_LAYOUT_H

#include "shaders/shared/light_layout.h"
#include "shaders/shared/materials.h"

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

#define SHAPE_PLANE 0  // z = 0
#define SHAPE_DISC 1   // z = 0, x^2 + y^2 <= 1
#define SHAPE_QUAD 2   // z = 0, |x| <= 1, |y| <= 1
#define SHAPE_BOX 3    // |x|, |y|, |z| <= 1, hit from both sides
#define SHAPE_SPHERE 4 // x^2 + y^2 + z^2 = 1, likewise

#define MAX_SHAPES 64
// Scenes with at most this many shapes have the shapes' kinds compiled into their programs and the shapes' rows in the
// frame parameters.
#define HELD_SHAPES 6
#define SHAPE_KIND_BITS 3u  // per shape in that constant, the first lowest, above the count:
#define SHAPE_COUNT_BITS 4u // 1 + number of shapes; 0: the scene has more

// An analytic surface: the transformed unit form of its kind.
struct Shape {
    vec4 row_x; // rows of local_from_render: xyz linear part, w translation
    vec4 row_y;
    vec4 row_z;
    uvec4 kind; // x: SHAPE_*, y: material, z: SHAPE_* bits below
};
#define SHAPE_VECTORS 4
#define SHAPE_UNSEEN_BY_CAMERA 1u // area lights invisible to camera rays
#define SHAPE_BACKDROP 2u         // surroundings: ignored by first hits and coverage
#define SHAPE_CASTS_CAUSTICS 4u

#define MAX_COLOR_RANGES 8

// Maximum number of half-spaces of all clips of a scene together, as of five boxes and two planes. Every instance has a
// copy of 512 bytes, so the parameters of thousands of tiles stay within a few megabytes.
#define MAX_CLIP_PLANES 32

// One .pro in the scene: the transform of its cube, its encoding and its materials. All tiles of a set share the number
// and materials of the set's instance; the hits of each are clipped to its core.
struct InstanceParams {
    vec4 row_x; // rows of cube_from_render, a similarity: xyz linear part, w translation
    vec4 row_y;
    vec4 row_z;
    vec4 splat;        // x: radius_max, y: radius_step, z: blend_slab, w: cube units per render unit
    vec4 grid_scale;   // x: entry grid cells per cube unit, y: one position step in cells
    uvec4 grid_origin; // xyz: lowest cell, in cells from the cube's corner; w: tiles: 1 + number in the set, else 0
    uvec4 grid_size;   // xyz: cells; w: place among the scene's instances
    uvec4 grid_words;  // x: words per layer, y: index of the last word, z: index of the last brick word, w: clip planes
    uvec4 materials; // x: number of this instance, y: first material, z: number of colour ranges, w: 1: casts caustics
    vec4 core_low;   // tiles: corners of the core, grid units; w: margin for rounding of a ray's position
    vec4 core_high;  // w: factor of splat radii for self-intersection distances (shaders/trace/offset.glsl)
    // Gaussians: largest harmonics of degree 1, 2, 3, relative to which those of each Gaussian are stored
    vec4 harmonics;
    uvec4 color_range[MAX_COLOR_RANGES]; // x, y: lowest and highest sRGB, 8 bits each, red lowest; z: material
    vec4 clip_planes[MAX_CLIP_PLANES];   // in the cube: points p with dot(xyz, p) >= w are kept; xyz: unit length
};

// A tile in a block of the device's texel pool, with the starts of its sections in the block, in words and in texels of
// four words. Programs read all tiles of a block through one binding.
struct PooledTile {
    InstanceParams instance;
    uvec4 words;  // grid, bricks, slabs, blending
    uvec4 quads;  // cells, near splats, splats, noise
    uvec4 listed; // x: in words
};
#define INSTANCE_VECTORS 52
#define POOLED_TILE_VECTORS 55

#ifdef __cplusplus
POINTRT_ROWS(Material, MATERIAL_VECTORS);
POINTRT_ROWS(Shape, SHAPE_VECTORS);
POINTRT_ROWS(Light, LIGHT_VECTORS);
POINTRT_ROWS(InstanceParams, INSTANCE_VECTORS);
static_assert(INSTANCE_VECTORS == 12 + MAX_COLOR_RANGES + MAX_CLIP_PLANES);
POINTRT_ROWS(PooledTile, POOLED_TILE_VECTORS);
} // namespace pointrt::gpu
#endif

#endif

// SPDX-License-Identifier: Apache-2.0
// Shapes and instances as the shaders read them: one header for C++ and GLSL (lights: light_layout.h, materials:
// materials.h).
// Lengths are in render units, the frame that all instances and shapes share (runtime/device_scene/render_space.h).
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
#define SHAPE_BOX 3    // |x|, |y|, |z| <= 1, hit from outside and from inside
#define SHAPE_SPHERE 4 // x^2 + y^2 + z^2 = 1, likewise

#define MAX_SHAPES 64
// Programs for scenes of no more shapes than these know their kinds when they are built and have their rows at hand.
#define HELD_SHAPES 6
#define SHAPE_KIND_BITS 3u  // of each in that knowledge, the first lowest, above
#define SHAPE_COUNT_BITS 4u // 1 + their number; 0: the scene has more

// A surface without splats, in the unit form of its kind.
struct Shape {
    vec4 row_x; // rows of local_from_render: xyz linear part, w translation
    vec4 row_y;
    vec4 row_z;
    uvec4 kind; // x: SHAPE_*, y: material, z: bits, see below
};
#define SHAPE_VECTORS 4
#define SHAPE_UNSEEN_BY_CAMERA 1u // lamps that light without being seen
#define SHAPE_BACKDROP 2u         // not of the scene: first hits and coverage pass through it
#define SHAPE_CASTS_CAUSTICS 4u

#define MAX_COLOR_RANGES 8

// One .pro in the scene: how its cube lies in render space, its encoding and its materials. Tiles of a set are one
// instance: they have its number and its materials, and each a core, in which its hits count.
struct InstanceParams {
    vec4 row_x; // rows of cube_from_render, a similarity: xyz linear part, w translation
    vec4 row_y;
    vec4 row_z;
    vec4 splat;        // x: radius_max, y: radius_step, z: blend_slab, w: cube units in a render unit
    vec4 grid_scale;   // x: entry grid cells in a cube unit, y: one position step in cells
    uvec4 grid_origin; // xyz: lowest cell, in cells from the cube's corner; w: of a tile 1 + its number in its set,
                       // else 0
    uvec4 grid_size;   // xyz: cells
    uvec4 grid_words;  // x: in a layer, y: number of the last, z: of the last one of a brick
    uvec4 materials;   // x: number of this instance, y: its first material, z: colour ranges, w: 1: casts caustics
    vec4 core_low;     // of a tile, in grid units: corners of its core; w: how far rounding may put a ray beside it
    vec4 core_high;    // w: so much of its radius counts where a ray leaves a disc (shaders/trace/offset.glsl)
    uvec4 color_range[MAX_COLOR_RANGES]; // x, y: lowest and highest sRGB, 8 bits each, red lowest; z: material
};

#ifdef __cplusplus
POINTRT_ROWS(Material, MATERIAL_VECTORS);
POINTRT_ROWS(Shape, SHAPE_VECTORS);
POINTRT_ROWS(Light, LIGHT_VECTORS);
POINTRT_ROWS(InstanceParams, 11 + MAX_COLOR_RANGES);
} // namespace pointrt::gpu
#endif

#endif

// SPDX-License-Identifier: Apache-2.0
// Materials, shapes and instances as the shaders read them: one header for C++ and GLSL (lights: light_layout.h).
// Lengths are in render units, the frame that all instances and shapes share (runtime/device_scene/render_space.h).
#ifndef POINTRT_SHADERS_SCENE_LAYOUT_H
#define POINTRT_SHADERS_SCENE_LAYOUT_H

#include "shaders/shared/light_layout.h"
#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// What happens to light at a surface.
#define MATERIAL_MATTE 0   // Lambert, a mirror share, and for phong and whitted a Phong highlight
#define MATERIAL_METAL 1   // GGX; base is the reflectance at normal incidence
#define MATERIAL_PLASTIC 2 // a GGX dielectric coat over Lambert
#define MATERIAL_MIRROR 3  // base is the reflectance
#define MATERIAL_GLASS 4   // smooth; reflects and refracts

#define MATERIAL_USES_SPLAT_COLOR 1u
#define MATERIAL_THIN 2u // glass: a pane, which light crosses without being bent

struct Material {
    vec4 base;       // linear reflectance; w: as bits, MATERIAL_USES_SPLAT_COLOR, MATERIAL_THIN
    vec4 gloss;      // x: MATERIAL_*, y: roughness (GGX alpha is its square), z: index of refraction, w: mirror share
    vec4 phong;      // x: weight of the Phong highlight, y: its exponent
    vec4 emission;   // radiance, on both sides; w: as bits, the light that stands for it or NO_LIGHT
    vec4 absorption; // glass: of the light inside, per unit length
};
#define MATERIAL_VECTORS 5

#define SHAPE_PLANE 0  // z = 0
#define SHAPE_DISC 1   // z = 0, x^2 + y^2 <= 1
#define SHAPE_QUAD 2   // z = 0, |x| <= 1, |y| <= 1
#define SHAPE_BOX 3    // |x|, |y|, |z| <= 1, hit from outside and from inside
#define SHAPE_SPHERE 4 // x^2 + y^2 + z^2 = 1, likewise

#define MAX_SHAPES 64

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

// One .pro in the scene: how its cube lies in render space, its encoding and its materials.
struct InstanceParams {
    vec4 row_x; // rows of cube_from_render, a similarity: xyz linear part, w translation
    vec4 row_y;
    vec4 row_z;
    vec4 splat;        // x: radius_max, y: radius_step, z: blend_slab, w: cube units in a render unit
    vec4 grid_scale;   // x: entry grid cells in a cube unit, y: one position step in cells
    uvec4 grid_origin; // xyz: lowest cell, in cells from the cube's corner
    uvec4 grid_size;   // xyz: cells
    uvec4 grid_words;  // x: in a layer, y: number of the last, z: of the last one of a brick
    uvec4 materials;   // x: number of this instance, y: its first material, z: colour ranges, w: 1: casts caustics
    uvec4 color_range[MAX_COLOR_RANGES]; // x, y: lowest and highest sRGB, 8 bits each, red lowest; z: material
};

#ifdef __cplusplus
POINTRT_ROWS(Material, MATERIAL_VECTORS);
POINTRT_ROWS(Shape, SHAPE_VECTORS);
POINTRT_ROWS(Light, LIGHT_VECTORS);
POINTRT_ROWS(InstanceParams, 9 + MAX_COLOR_RANGES);
} // namespace pointrt::gpu
#endif

#endif

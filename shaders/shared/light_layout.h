// SPDX-License-Identifier: Apache-2.0
// The kinds of light and their row on the device: one header for C++ and GLSL.
//
// A new kind takes a line in LIGHT_KINDS, its number and its fields here; the compiler then asks for the rest, in
// runtime/scene/light.h for its alternative of LightDescription, in shaders/shade/lights.glsl for its functions.
#ifndef POINTRT_SHADERS_LIGHT_LAYOUT_H
#define POINTRT_SHADERS_LIGHT_LAYOUT_H

#ifdef __cplusplus
#include <algorithm>

#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// As in the order of LightDescription's alternatives.
#define LIGHT_POINT 0
#define LIGHT_SPOT 1
#define LIGHT_SUN 2 // a distant disc, or a direction where its angle is 0
#define LIGHT_SPHERE 3
#define LIGHT_QUAD 4 // shines on both sides
#define LIGHT_DISC 5 // likewise

// clang-format off
// row(number, name, whether it has a surface, which then is a shape as well)
#define LIGHT_KINDS(row) \
    row(LIGHT_POINT, Point, false) \
    row(LIGHT_SPOT, Spot, false) \
    row(LIGHT_SUN, Sun, false) \
    row(LIGHT_SPHERE, Sphere, true) \
    row(LIGHT_QUAD, Quad, true) \
    row(LIGHT_DISC, Disc, true)
// clang-format on

#define MAX_LIGHT_KINDS 8 // FEATURE_LIGHT has a bit for each
// The environment image: a light to choose from, but none of a description's.
#define LIGHT_SKY MAX_LIGHT_KINDS

#define MAX_LIGHTS 32
#define NO_LIGHT 0xFFFFFFFFu

struct Light {
    vec4 position; // unless it is afar; w: LIGHT_KIND
    // point, spot: radiant intensity (W/sr in the frame's units: irradiance times squared distance);
    // sun: irradiance on a surface that faces it; those with a surface: radiance
    vec4 power;
    vec4 axis;   // unit length: spot: where it points; sun: towards it; flat ones: their normal
    vec4 edge_u; // quad: half edge; disc: a radius
    vec4 edge_v; // the other one, at right angles to the first
};
#define LIGHT_VECTORS 5

// What the vectors hold besides, by name: to read in both languages, to write in C++.
#define LIGHT_KIND(light) (light).position.w // LIGHT_* as a number
#define LIGHT_SHAPE(light) (light).edge_v.w  // those with a surface: number of their shape, as bits
#define SPOT_OUTER_COSINE(light) (light).axis.w
#define SPOT_INNER_COSINE(light) (light).edge_u.x // inside of this angle it is not dimmed
#define SUN_COSINE(light) (light).axis.w          // of its disc's angular radius
#define SPHERE_RADIUS(light) (light).axis.w

#ifdef __cplusplus
using std::clamp, std::max;
#define LIGHT_FUNCTION inline
#define LIGHT_REAL double
#else
#define LIGHT_FUNCTION
#define LIGHT_REAL float
#endif

// Share of a spot's light at an angle off its axis, by cosines.
LIGHT_FUNCTION LIGHT_REAL spotFalloff(LIGHT_REAL cosine, LIGHT_REAL outer_cosine, LIGHT_REAL inner_cosine) {
    // a hard edge has both angles alike
    LIGHT_REAL share = clamp((cosine - outer_cosine) / max(inner_cosine - outer_cosine, 1e-7), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

#ifdef __cplusplus
POINTRT_ROWS(Light, LIGHT_VECTORS);
} // namespace pointrt::gpu
#endif

#endif

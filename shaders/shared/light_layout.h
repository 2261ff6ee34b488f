// SPDX-License-Identifier: Apache-2.0
// The kinds of light and their row on the device. Valid in C++ and GLSL.
//
// To add a kind, add its number, its line in LIGHT_KINDS and its fields here. The compiler then demands an alternative
// of LightDescription (runtime/scene/light.h) and the functions of shaders/shade/lights.glsl.
#ifndef POINTRT_SHADERS_LIGHT_LAYOUT_H
#define POINTRT_SHADERS_LIGHT_LAYOUT_H

#ifdef __cplusplus
#include <algorithm>

#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// In the order of LightDescription's alternatives.
#define LIGHT_POINT 0
#define LIGHT_SPOT 1
#define LIGHT_SUN 2 // a distant disc, or a direction if its angle is 0
#define LIGHT_SPHERE 3
#define LIGHT_QUAD 4 // two-sided
#define LIGHT_DISC 5 // two-sided

// clang-format off
// row(number, name, whether the light has a surface and so is a shape, too)
#define LIGHT_KINDS(row) \
    row(LIGHT_POINT, Point, false) \
    row(LIGHT_SPOT, Spot, false) \
    row(LIGHT_SUN, Sun, false) \
    row(LIGHT_SPHERE, Sphere, true) \
    row(LIGHT_QUAD, Quad, true) \
    row(LIGHT_DISC, Disc, true)
// clang-format on

#define MAX_LIGHT_KINDS 8 // bits of FEATURE_LIGHT
// The environment image: sampled as a light, but described by SkyDescription.
#define LIGHT_SKY MAX_LIGHT_KINDS

#define MAX_LIGHTS 32
#define NO_LIGHT 0xFFFFFFFFu

struct Light {
    vec4 position; // unused by the sun; w: LIGHT_KIND
    // point, spot: radiant intensity (W/sr in the frame's units: irradiance times squared distance);
    // sun: irradiance on a surface facing it; area lights: radiance
    vec4 power;
    vec4 axis;   // unit vector: spot: direction it points in; sun: direction towards it; quad, disc: normal
    vec4 edge_u; // quad: half an edge; disc: a radius
    vec4 edge_v; // perpendicular to edge_u: likewise
};
#define LIGHT_VECTORS 5

// Names for vector components that hold other values. GLSL may only read them, C++ may also assign them.
#define LIGHT_KIND(light) (light).position.w // LIGHT_* as a number
#define LIGHT_SHAPE(light) (light).edge_v.w  // area lights: index of their shape, as bits
#define SPOT_OUTER_COSINE(light) (light).axis.w
#define SPOT_INNER_COSINE(light) (light).edge_u.x // full intensity within this angle
#define SUN_COSINE(light) (light).axis.w          // of the angular radius of its disc
#define SPHERE_RADIUS(light) (light).axis.w

#ifdef __cplusplus
using std::clamp, std::max;
#define LIGHT_FUNCTION inline
#define LIGHT_REAL double
#else
#define LIGHT_FUNCTION
#define LIGHT_REAL float
#endif

// Share of a spot light's intensity at an angle to its axis, all angles given by their cosines.
LIGHT_FUNCTION LIGHT_REAL spotFalloff(LIGHT_REAL cosine, LIGHT_REAL outer_cosine, LIGHT_REAL inner_cosine) {
    // the two angles are equal for a hard edge
    LIGHT_REAL share = clamp((cosine - outer_cosine) / max(inner_cosine - outer_cosine, 1e-7), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

#ifdef __cplusplus
POINTRT_ROWS(Light, LIGHT_VECTORS);
} // namespace pointrt::gpu
#endif

#endif

// SPDX-License-Identifier: Apache-2.0
// Rays that come in batches, and what becomes of them: one header for C++ and GLSL.
#ifndef POINTRT_SHADERS_CAST_LAYOUT_H
#define POINTRT_SHADERS_CAST_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// Further than any hit: t_max of rays without end.
#define CAST_FARTHEST 1e30f

// In render space. Origins are near what can be hit, whatever the ray's own is: floats then tell it finely.
struct CastRay {
    vec3 origin;
    float t_max;    // below 0: it meets nothing
    vec3 direction; // unit length
    float unused;
};
#define CAST_RAY_VECTORS 2

struct CastHit {
    float t;     // to the disc
    uint splat;  // NO_INDEX: nothing is hit
    uint normal; // the splat's word that holds it (PRO_NORMAL_BITS)
    uint unused;
};

// In place of a splat's number, and of whether a ray is stopped: the host must see to that ray.
#define CAST_ODD 0xFFFFFFFEu

// Squares of lengths that floats can reckon with: of directions, and of how far off rays begin, world units.
#define GIVEN_LEAST 1e-30f
#define GIVEN_MOST 1e30f
// Of the way to the scene as floats tell it, so much is never too much: a few times 2^-24 less.
#define GIVEN_SHORT 0.999999f

// How rays as callers give them become rays in an instance's cube, and hits theirs.
struct GivenPush {
    double origin_x; // the cube's middle, world units
    double origin_y;
    double origin_z;
    double scale; // the cube's edge, world units
    double t_min; // lengths of the direction
    double t_max;
    float units;  // edges in a world unit
    float radius; // of a sphere around the cube, world units
    uint rays;
    uint first_texel; // of the first of them, which is one of two that are three texels
};

struct CastPush {
    uint rays;
    uint first; // row; the others follow
    uint unused_0;
    uint unused_1;
};

#ifdef __cplusplus
POINTRT_ROWS(CastRay, CAST_RAY_VECTORS);
POINTRT_ROW(CastRay, direction);
POINTRT_ROWS(CastHit, 1);
POINTRT_ROWS(CastPush, 1);
static_assert(sizeof(GivenPush) == 4 * 16 && offsetof(GivenPush, units) == 48);

// A hit of a given ray, whose t is in lengths of its direction, +infinity for a miss.
struct GivenHit {
    double t;
    uint splat; // NO_INDEX: nothing is hit; CAST_ODD
    uint normal;
};
static_assert(sizeof(GivenHit) == 16);
} // namespace pointrt::gpu
#endif

#endif

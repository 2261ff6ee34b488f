// SPDX-License-Identifier: Apache-2.0
// Batches of rays and their hits. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_CAST_LAYOUT_H
#define POINTRT_SHADERS_CAST_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// Farther than any hit: t_max of unbounded rays.
#define CAST_FARTHEST 1e30f

// In render space. The origin has been moved along the ray close to the instance, to keep float precision.
struct CastRay {
    vec3 origin;
    float t_max;    // negative: the ray hits nothing
    vec3 direction; // unit length
    float unused;
};
#define CAST_RAY_VECTORS 2

struct CastHit {
    float t;     // to the disc or ball
    uint splat;  // NO_INDEX: a miss
    uint normal; // encoded as in the word of a splat that holds its normal (PRO_NORMAL_BITS)
    uint unused;
};

// In place of a splat's number or an occlusion result: the host must trace this ray.
#define CAST_ODD 0xFFFFFFFEu

// Range of squared lengths (of directions, and of distances of origins in world units) that float arithmetic handles.
#define GIVEN_LEAST 1e-30f
#define GIVEN_MOST 1e30f
// Factor that keeps the float distance to the scene from being too large: 1 minus a few times 2^-24.
#define GIVEN_SHORT 0.999999f

// Transform between the caller's rays and rays in an instance's cube.
struct GivenPush {
    double origin_x; // centre of the cube, world units
    double origin_y;
    double origin_z;
    double scale; // edge of the cube, world units
    double t_min; // in lengths of the direction
    double t_max;
    float units;  // cube edges per world unit
    float radius; // of the sphere around the cube, world units
    uint rays;
    uint first_texel; // of the first ray; for float rays, that ray has an even number, as two rays take three texels
};

struct CastPush {
    uint rays;
    uint first; // row of the first ray; the others follow
    uint unused_0;
    uint unused_1;
};

#ifdef __cplusplus
POINTRT_ROWS(CastRay, CAST_RAY_VECTORS);
POINTRT_ROW(CastRay, direction);
POINTRT_ROWS(CastHit, 1);
POINTRT_ROWS(CastPush, 1);
static_assert(sizeof(GivenPush) == 4 * 16 && offsetof(GivenPush, units) == 48);

// A hit of a caller's ray. t: in lengths of its direction, +infinity for a miss.
struct GivenHit {
    double t;
    uint splat; // NO_INDEX: a miss; or CAST_ODD
    uint normal;
};
static_assert(sizeof(GivenHit) == 16);
} // namespace pointrt::gpu
#endif

#endif

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
} // namespace pointrt::gpu
#endif

#endif

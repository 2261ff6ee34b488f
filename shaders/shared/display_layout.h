// SPDX-License-Identifier: Apache-2.0
// What the programs between the film and the window are called with: one header for C++ and GLSL.
#ifndef POINTRT_SHADERS_DISPLAY_LAYOUT_H
#define POINTRT_SHADERS_DISPLAY_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

#define DISPLAY_GROUP 128

// What is shown of the film.
#define SHOWN_BEAUTY 0u
#define SHOWN_ALBEDO 1u
#define SHOWN_NORMAL 2u
#define SHOWN_DEPTH 3u
#define SHOWN_DIRECT 4u
#define SHOWN_INDIRECT 5u
#define SHOWN_CAUSTIC 6u
#define SHOWN_NOISE 7u

struct ResolveParams {
    uint first; // pixel
    uint count;
    uint film_pixels;
    uint shown;  // SHOWN_*
    float share; // 1 / samples
    float samples;
    float scale;       // input units in a render unit
    float depth_black; // render units
};

struct TonemapParams {
    uint first; // pixel
    uint count;
    float gain;
    uint is_light; // 1: to be brought into the range of screens, 0: it is there
};

#ifdef __cplusplus
POINTRT_ROWS(ResolveParams, 2);
POINTRT_ROWS(TonemapParams, 1);
} // namespace pointrt::gpu
#endif

#endif

// SPDX-License-Identifier: Apache-2.0
// What the programs between the film and the window are called with: one header for C++ and GLSL.
#ifndef POINTRT_SHADERS_DISPLAY_LAYOUT_H
#define POINTRT_SHADERS_DISPLAY_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

#define DISPLAY_GROUP 128

struct ResolveParams {
    uint first; // pixel
    uint count;
    uint film_pixels;
    uint shown;  // number of a part (shaders/shared/film_parts.h)
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

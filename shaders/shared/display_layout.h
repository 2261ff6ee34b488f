// SPDX-License-Identifier: Apache-2.0
// Push constants of the display shaders. Valid in C++ and GLSL.
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
    uint shown;  // number of the film part to show (shaders/shared/film_parts.h)
    float share; // 1 / samples
    float samples;
    float scale;       // input units per render unit
    float depth_black; // depth shown as black, render units
};

// How the window shows values.
#define DISPLAY_AS_STORED 0u  // already in display range
#define DISPLAY_CLIPPED 1u    // linear light, clipped at 1
#define DISPLAY_COMPRESSED 2u // linear light with compressed highlights

struct TonemapParams {
    uint first; // pixel
    uint count;
    float gain;
    uint display; // DISPLAY_*
};

#ifdef __cplusplus
POINTRT_ROWS(ResolveParams, 2);
POINTRT_ROWS(TonemapParams, 1);
} // namespace pointrt::gpu
#endif

#endif

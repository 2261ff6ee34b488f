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
    uvec4 range; // x: first pixel, y: pixels, z: pixels of the film, w: SHOWN_*
    vec4 scale;  // x: 1 / samples, y: samples, z: input units in a render unit, w: render units at which depth is black
};

struct TonemapParams {
    uvec4 range; // x: first pixel, y: pixels
    vec4 look;   // x: gain; y: 1: bring light into the range of screens, 0: it is there
};

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif

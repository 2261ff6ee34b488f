// SPDX-License-Identifier: Apache-2.0
// An environment image as the shaders read it. Valid in C++ and GLSL.
//
// Map space has +Y up. Row 0 of the image is the zenith, its last row the nadir. The middle column looks along -Z;
// columns increase to the right, towards +X:
//   direction = (sin(theta) sin(phi), cos(theta), -sin(theta) cos(phi)), phi = 2 pi (u - 1/2), theta = pi v,
// with u and v from 0 to 1 over the image's width and height.
#ifndef POINTRT_SHADERS_ENVIRONMENT_LAYOUT_H
#define POINTRT_SHADERS_ENVIRONMENT_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

struct EnvironmentFrame {
    uvec4 size; // x: width, y: height of the image; z: columns, w: rows of the sampling grid
    vec4 row_x; // rows of map_from_world, a rotation; w: strength, multiplies the radiance
    vec4 row_y;
    vec4 row_z;
};

#ifdef __cplusplus
POINTRT_ROWS(EnvironmentFrame, 4);
} // namespace pointrt::gpu
#endif

#endif

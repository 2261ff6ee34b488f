// SPDX-License-Identifier: Apache-2.0
// Gaussians as the shaders read them. An instance of Gaussians has the buffers of a scan, with other contents
// (runtime/device_scene/gaussian_upload.h), so that all programs share one set of bindings. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_GAUSSIAN_LAYOUT_H
#define POINTRT_SHADERS_GAUSSIAN_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// In the splat buffer. The ellipsoid in which a Gaussian counts is |M (x - mean)| <= 1.
struct GaussianRows {
    vec4 row_x; // of M, from cube units; w: mean
    vec4 row_y;
    vec4 row_z;
    vec4 look; // x: opacity; yzw: constant term of the colour, display-encoded
};
#define GAUSSIAN_VECTORS 4

// In the near splat buffer: a node of the tree, one texel.
struct GaussianNode {
    uint children; // node number of the first of 8; 0: none
    uint first;    // index in the brick buffer, which holds the lists
    uint count;
    uint parent; // NO_INDEX at the root
};

// In the cell buffer: the harmonics of a Gaussian, a word for each coefficient: red, green, blue as signed bytes.
// Texels per Gaussian by degree: 0, 1, 2, 4.
#define HARMONIC_TEXELS(degree) ((degree) == 3u ? 4u : (degree))

// Largest opacity of a Gaussian along a ray, as in Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field
// Rendering, 2023.
#define GAUSSIAN_ALPHA_MAX 0.99f

// A ray ends when its transmittance falls below this, as in Kerbl et al.
#define GAUSSIAN_TRANSMITTANCE_MIN 1e-4f

#ifdef __cplusplus
POINTRT_ROWS(GaussianRows, GAUSSIAN_VECTORS);
POINTRT_ROWS(GaussianNode, 1);
} // namespace pointrt::gpu
#endif

#endif

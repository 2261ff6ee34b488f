// SPDX-License-Identifier: Apache-2.0
// The shape of the table of GGX's directional albedo (runtime/device_scene/ggx_albedo.h), for C++ and GLSL.
#ifndef POINTRT_SHADERS_GGX_TABLE_H
#define POINTRT_SHADERS_GGX_TABLE_H

// Cosines in a row, and rows of roughness; a further row holds each roughness's cosine-weighted mean.
#define GGX_TABLE_SIDE 32
#define GGX_TABLE_ENTRIES (GGX_TABLE_SIDE * (GGX_TABLE_SIDE + 1))

// The smoothest that GGX gets, the table's first row: alpha is 0.0009 there, a lobe a twentieth of a degree wide.
// Below that single precision no longer tells its directions apart.
#define GGX_MIN_ROUGHNESS 0.03f

#endif

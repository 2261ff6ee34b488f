// SPDX-License-Identifier: Apache-2.0
// Size of the table of GGX directional albedo (runtime/device_scene/ggx_albedo.h). Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_GGX_TABLE_H
#define POINTRT_SHADERS_GGX_TABLE_H

// Cosines per row, and rows of roughness; one more row holds the cosine-weighted mean for each roughness.
#define GGX_TABLE_SIDE 32
#define GGX_TABLE_ENTRIES (GGX_TABLE_SIDE * (GGX_TABLE_SIDE + 1))

// Lowest roughness, the table's first row: alpha is 0.0009, a lobe a twentieth of a degree wide. Single precision
// cannot resolve directions within narrower lobes.
#define GGX_MIN_ROUGHNESS 0.03f

#endif

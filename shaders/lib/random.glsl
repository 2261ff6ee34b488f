// SPDX-License-Identifier: Apache-2.0
// Hashed random bits.
#ifndef POINTRT_SHADERS_RANDOM_GLSL
#define POINTRT_SHADERS_RANDOM_GLSL

// PCG-3D (Jarzynski and Olano, Hash Functions for GPU Rendering, 2020).
uvec3 pcg3(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Hashed random numbers, the same for a pixel, sample and dimension whatever else is rendered.

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

// Three numbers in [0, 1) with 24 bits each.
vec3 random3(uint pixel, uint sample_index, uint dimension) {
    uvec3 bits = pcg3(uvec3(pixel, sample_index, dimension ^ (params.mode.w * 0x9E3779B9u)));
    return vec3(bits >> 8u) * (1.0 / 16777216.0);
}

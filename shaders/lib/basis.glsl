// SPDX-License-Identifier: Apache-2.0
// A frame around a direction.
#ifndef POINTRT_SHADERS_FRAME_GLSL
#define POINTRT_SHADERS_FRAME_GLSL

// Columns: two tangents and n, which has unit length. frame * v leads out of the frame, v * frame into it.
// Duff et al., Building an Orthonormal Basis, Revisited (2017).
mat3 frameAround(vec3 n) {
    float turn = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (turn + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + turn * n.x * n.x * a, turn * b, -turn * n.x), vec3(b, turn + n.y * n.y * a, -n.y), n);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Orthonormal basis around a direction.
#ifndef POINTRT_SHADERS_FRAME_GLSL
#define POINTRT_SHADERS_FRAME_GLSL

// Columns: two tangents and n, which must have unit length. frame * v transforms v out of the frame, v * frame into it.
// Duff et al., Building an Orthonormal Basis, Revisited (2017).
mat3 frameAround(vec3 n) {
    float sign_z = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (sign_z + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + sign_z * n.x * n.x * a, sign_z * b, -sign_z * n.x), vec3(b, sign_z + n.y * n.y * a, -n.y),
                n);
}

#endif

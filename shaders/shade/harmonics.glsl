// SPDX-License-Identifier: Apache-2.0
// View-dependent colours of Gaussians: real spherical harmonics with the order and signs of Kerbl et al., 3D Gaussian
// Splatting for Real-Time Radiance Field Rendering, 2023.
#ifndef POINTRT_SHADERS_HARMONICS_GLSL
#define POINTRT_SHADERS_HARMONICS_GLSL
#include "shaders/shared/gaussian_layout.h"
#include "shaders/trace/instance.glsl"

// Degree of the spherical harmonics of an instance's Gaussians, 0 to 3.
layout(constant_id = SPEC_HARMONICS) const uint kHarmonics = 3u;

// The four coefficients of a texel, weighted by the values of their basis functions.
vec3 weighHarmonics(uvec4 words, vec4 basis) {
    return basis.x * unpackSnorm4x8(words.x).rgb + basis.y * unpackSnorm4x8(words.y).rgb +
           basis.z * unpackSnorm4x8(words.z).rgb + basis.w * unpackSnorm4x8(words.w).rgb;
}

// The colour of a Gaussian without its constant term. d: unit direction of the ray in the frame of the Gaussians.
// Coefficients are stored relative to the largest one of their degree (instance.harmonics).
vec3 harmonicsAlong(uint gaussian, vec3 d) {
    if (kHarmonics == 0u) return vec3(0.0);
    float x = d.x, y = d.y, z = d.z, xx = x * x, yy = y * y, zz = z * z;
    vec3 most = instance.harmonics.xyz;
    uint first = gaussian * HARMONIC_TEXELS(kHarmonics);
    const float kFirst = 0.4886025119029199, kProduct = 1.0925484305920792;
    vec3 linear = kFirst * most.x * vec3(-y, z, -x);
    float quadratic = kHarmonics > 1u ? most.y : 0.0;
    vec3 color = weighHarmonics(loadCell(first), vec4(linear, quadratic * kProduct * x * y));
    if (kHarmonics == 1u) return color;
    const float kAxial = 0.31539156525252005, kSquares = 0.5462742152960396;
    vec4 second = vec4(-kProduct * y * z, kAxial * (2.0 * zz - xx - yy), -kProduct * x * z, kSquares * (xx - yy));
    color += weighHarmonics(loadCell(first + 1u), quadratic * second);
    if (kHarmonics == 2u) return color;
    const float kCubic = 0.5900435899266435, kMixed = 0.4570457994644658;
    vec4 third = vec4(-kCubic * y * (3.0 * xx - yy), 2.890611442640554 * x * y * z, -kMixed * y * (4.0 * zz - xx - yy),
                      0.3731763325901154 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy));
    vec4 fourth = vec4(-kMixed * x * (4.0 * zz - xx - yy), 1.445305721320277 * z * (xx - yy),
                       -kCubic * x * (xx - 3.0 * yy), 0.0);
    color += weighHarmonics(loadCell(first + 2u), most.z * third);
    color += weighHarmonics(loadCell(first + 3u), most.z * fourth);
    return color;
}

#endif

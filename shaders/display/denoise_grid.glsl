// SPDX-License-Identifier: Apache-2.0
// The pixel of an invocation, and its neighbours, in the denoiser's programs. The includer declares the push constants
// it is called with and the size of its workgroups.
#ifndef POINTRT_SHADERS_DENOISE_GRID_GLSL
#define POINTRT_SHADERS_DENOISE_GRID_GLSL

bool isInside(ivec2 pixel, ivec2 size) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, size)); }

// Of the pixel, or of the image's nearest one.
int texelOf(ivec2 pixel, ivec2 size) {
    ivec2 clamped = clamp(pixel, ivec2(0), size - 1);
    return clamped.y * size.x + clamped.x;
}

#endif

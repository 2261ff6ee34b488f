// SPDX-License-Identifier: Apache-2.0
// Pixel addressing of the denoiser's programs. The includer declares push constants and the workgroup size.
#ifndef POINTRT_SHADERS_DENOISE_GRID_GLSL
#define POINTRT_SHADERS_DENOISE_GRID_GLSL

bool isInside(ivec2 pixel, ivec2 size) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, size)); }

// Texel of the pixel, clamped to the image.
int texelOf(ivec2 pixel, ivec2 size) {
    ivec2 clamped = clamp(pixel, ivec2(0), size - 1);
    return clamped.y * size.x + clamped.x;
}

#endif

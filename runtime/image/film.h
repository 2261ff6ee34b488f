// SPDX-License-Identifier: Apache-2.0
// What comes out of rendering: the plain structs between the tracer and the image files.
#pragma once

#include <cstdint>
#include <vector>

namespace pointrt {

/// Rays counted on the device while tracing.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, secondary = 0;
};

/// Row-major pixels, y down. The first-hit arrays belong to the pixel's centre ray.
struct Film {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;     ///< 4 a pixel: linear light, background included; share covered by the scene
    std::vector<float> depth;    ///< 1 a pixel, along the ray from its start, input units; +infinity: nothing hit
    std::vector<float> normal;   ///< 3 a pixel, unit, towards the eye; 0 where nothing is hit
    std::vector<float> position; ///< 3 a pixel, input coordinates; 0 where nothing is hit

    /// Parts of the light in rgba and what a denoiser wants; each may be empty: not asked for.
    std::vector<float> direct;   ///< 3 a pixel: light that reached the first hit straight from a lamp
    std::vector<float> indirect; ///< 3 a pixel: light by way of other surfaces
    std::vector<float> caustic;  ///< 3 a pixel: light that was bundled or bent on its way to a matte surface
    std::vector<float> albedo;   ///< 3 a pixel, 0 to 1: reflectance of the first hit
    std::vector<std::uint32_t> splat_id, instance_id; ///< 1 a pixel; 0xFFFFFFFF: none
    std::vector<float> samples;                       ///< 1 a pixel: paths traced through it
    std::vector<float> variance;                      ///< 1 a pixel: of the mean luminance
};

} // namespace pointrt

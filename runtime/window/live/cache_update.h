// SPDX-License-Identifier: Apache-2.0
// Insertion of newly traced samples into the render cache.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/window/live/render_cache.h"
#include "runtime/window/live/sample_priority.h"

namespace pointrt {

/// The first hit and colour of the ray through a pixel's centre.
struct TracedPixel {
    std::uint32_t pixel = 0;   ///< index
    std::uint32_t color = 0;   ///< 0xAARRGGBB
    float distance = -1;       ///< to the hit, along the ray; negative: sky
    float view_dependence = 0; ///< 0 to 1
    bool on_shape = false;
};

/// How new samples are averaged with the cached colour.
struct SampleBlending {
    std::uint32_t frame = 0;   ///< number
    bool noisy = false;        ///< Monte Carlo light: one sample is unreliable
    bool camera_moves = false; ///< view-dependent colours are replaced, not averaged
};

/// Inserts traced samples, each pixel at most once.
void insertSamples(RenderCache& cache, ErrorMap& errors, const ViewProjection& view, const SampleBlending& blending,
                   std::span<const TracedPixel> traced);

/// A traced pixel as a cached point with a sample count of 0, and its depth.
CachedPoint toCachedPoint(const ViewProjection& view, const TracedPixel& traced, std::uint32_t frame);
float depthAlongView(const ViewProjection& view, const TracedPixel& traced);

} // namespace pointrt

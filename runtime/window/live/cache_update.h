// SPDX-License-Identifier: Apache-2.0
// What was traced into a carried picture.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/window/live/render_cache.h"
#include "runtime/window/live/sample_priority.h"

namespace pointrt {

/// What the ray through a pixel's middle has met.
struct TracedPixel {
    std::uint32_t pixel = 0;   ///< of the pixel
    std::uint32_t color = 0;   ///< 0xAARRGGBB
    float distance = -1;       ///< along the ray to what is seen; negative: the sky
    float view_dependence = 0; ///< 0 to 1
    bool on_shape = false;
};

/// How samples add up to a point's colour.
struct SampleBlending {
    std::uint32_t frame = 0;   ///< number
    bool noisy = false;        ///< light comes by chance: one sample says little
    bool camera_moves = false; ///< the camera: what mirrors show is another thing each time
};

/// Each pixel at most once.
void insertSamples(RenderCache& cache, ErrorMap& errors, const ViewProjection& view, const SampleBlending& blending,
                   std::span<const TracedPixel> traced);

/// A traced pixel as a point, without its samples, and how far ahead of the eye it is.
CachedPoint toCachedPoint(const ViewProjection& view, const TracedPixel& traced, std::uint32_t frame);
float depthAlongView(const ViewProjection& view, const TracedPixel& traced);

} // namespace pointrt

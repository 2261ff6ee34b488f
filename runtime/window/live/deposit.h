// SPDX-License-Identifier: Apache-2.0
// What was traced into a carried picture.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/window/live/carried_picture.h"
#include "runtime/window/live/urgency.h"

namespace pointrt {

/// What the ray through a pixel's middle has met.
struct TracedPixel {
    std::uint32_t number = 0;  ///< of the pixel
    std::uint32_t color = 0;   ///< 0xAARRGGBB
    float distance = -1;       ///< along the ray to what is seen; negative: the sky
    float view_dependence = 0; ///< 0 to 1
    bool on_shape = false;
};

/// How samples add up to a point's colour.
struct Mixing {
    std::uint32_t frame = 0; ///< number
    bool noisy = false;      ///< light comes by chance: one sample says little
    bool moves = false;      ///< the camera: what mirrors show is another thing each time
};

/// Each pixel at most once.
void depositPixels(CarriedPicture& picture, ErrorMap& errors, const CarryView& view, const Mixing& mixing,
                   std::span<const TracedPixel> traced);

/// A traced pixel as a point, without its samples, and how far ahead of the eye it is.
CarriedPoint pointOf(const CarryView& view, const TracedPixel& traced, std::uint32_t frame);
float aheadOf(const CarryView& view, const TracedPixel& traced);

} // namespace pointrt

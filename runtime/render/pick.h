// SPDX-License-Identifier: Apache-2.0
// What is under a pixel.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/render/band_tracer.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Of the ray through a pixel's centre.
struct Pick {
    std::uint32_t splat = 0, owner = 0; ///< owner: an instance's number, or OWNER_SHAPES
    std::optional<std::uint32_t> tile;  ///< of the owner's set, where it is one
    double distance = 0;                ///< along the ray, input units
    Vec3 position, normal;              ///< input frame
};

/// Traces that ray; none where it hits nothing. It borrows the tracer's buffers, which have room for the whole
/// picture's film: no strip may be under way, and of the film the row's first hits become the picture's.
std::optional<Pick> pickPixel(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                              std::uint32_t x, std::uint32_t y);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Picking: the first hit under a pixel.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/render/band_tracer.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// First hit of the ray through a pixel centre.
struct Pick {
    std::uint32_t splat = 0, owner = 0; ///< owner: an instance's number, or OWNER_SHAPES
    std::optional<std::uint32_t> tile;  ///< index in the set, if the owner is a set
    double distance = 0;                ///< along the ray, input units
    Vec3 position, normal;              ///< input frame
};

/// Traces that ray; none for a miss. Uses the tracer's buffers, which must have room for the film of the whole picture.
/// No strip may be in progress. Overwrites the first hits of the row in the film.
std::optional<Pick> pickPixel(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                              std::uint32_t x, std::uint32_t y);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Packs world rays for the device. Doubles move each ray's start to the box of what it may hit; from there floats are
// precise enough, wherever on Earth the scan lies.
#pragma once

#include <cstddef>
#include <span>

#include "pointrt/trace.hpp"
#include "runtime/cast/instance_residency.h"
#include "shaders/shared/cast_layout.h"

namespace pointrt {

/// Converts the t of a hit on the device to the ray's: t + per_unit * (t of the hit), in lengths of the ray's
/// direction.
struct RayStart {
    double t = 0;        ///< where the packed ray starts
    double per_unit = 0; ///< lengths per render unit
};

struct RayRow {
    Vec3 origin, direction;
};
RayRow rowAt(const RayRows& rays, std::size_t number);

/// A ray with its direction rescaled if its square would under- or overflow.
struct ScaledRay {
    Vec3 origin, direction;
    double size = 1; ///< length of the ray's direction in lengths of this one: t here is size times the ray's t
};
/// Throws RayError if the ray is not finite or its direction is 0.
ScaledRay scaledRay(const RayRows& rays, std::size_t number);

/// Throws Error kBadUsage unless 0 <= t_min <= t_max.
void requireLimits(const RayLimits& limits);

/// Packs the rays from number first on, as many as packed and starts hold. Throws RayError if a ray is not finite or
/// its direction is 0.
void packRays(const RayFrame& frame, const RayRows& rays, const RayLimits& limits, std::size_t first,
              std::span<gpu::CastRay> packed, std::span<RayStart> starts);

/// Packs one ray; limits and start are in lengths of its scaled direction.
gpu::CastRay packRay(const RayFrame& frame, const ScaledRay& ray, const RayLimits& limits, RayStart& start);

} // namespace pointrt

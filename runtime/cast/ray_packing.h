// SPDX-License-Identifier: Apache-2.0
// Rays of the world as the device takes them. All is reckoned in doubles until each ray starts beside what it may hit:
// floats tell that finely, wherever on Earth the scan lies.
#pragma once

#include <cstddef>
#include <span>

#include "pointrt/trace.hpp"
#include "runtime/cast/resident_targets.h"
#include "shaders/shared/cast_layout.h"

namespace pointrt {

/// t of a ray from that of its hit on the device, both in lengths of the ray's direction.
struct RayStart {
    double t = 0;        ///< where it starts there
    double per_unit = 0; ///< in a render unit
};

struct RayRow {
    Vec3 origin, direction;
};
RayRow rowAt(const RayRows& rays, std::size_t number);

/// A ray whose direction is one that can be reckoned with: in other lengths where it is very short or very long.
struct ScaledRay {
    Vec3 origin, direction;
    double size = 1; ///< of the ray's own direction in these lengths: t here is size times its own
};
/// Throws RayError for a row with a number that is not finite, or without a direction.
ScaledRay scaledRay(const RayRows& rays, std::size_t number);

/// Throws Error kBadUsage unless 0 <= t_min <= t_max.
void requireLimits(const RayLimits& limits);

/// The rays from number first on, as many as packed and starts both hold. Throws RayError for one with a number that
/// is not finite, or without a direction.
void packRays(const RayFrame& frame, const RayRows& rays, const RayLimits& limits, std::size_t first,
              std::span<gpu::CastRay> packed, std::span<RayStart> starts);

/// One of them; limits and start are in the lengths of the scaled ray.
gpu::CastRay packRay(const RayFrame& frame, const ScaledRay& ray, const RayLimits& limits, RayStart& start);

} // namespace pointrt

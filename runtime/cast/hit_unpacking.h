// SPDX-License-Identifier: Apache-2.0
// Hits from the device, converted to the caller's arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pointrt/trace.hpp"
#include "runtime/cast/ray_packing.h"

namespace pointrt {

/// Values in place of an instance's number: a miss, or a shape of a scene file, whose number is then in splat.
constexpr std::uint32_t kNothing = 0xFFFFFFFFu, kShape = 0xFFFFFFFEu;

/// The hit of a ray.
struct RayHit {
    double t = 0; ///< in lengths of the ray's direction
    std::uint32_t instance = kNothing;
    std::uint32_t splat = 0;
    std::uint32_t normal = 0; ///< encoded as in the words of a splat
};

/// The hit that the device found in an instance, with t clamped to limits; `otherwise` for a miss.
RayHit hitOf(const gpu::CastHit& found, std::uint32_t instance, const RayStart& start, const RayLimits& limits,
             const RayHit& otherwise);

/// Throws Error kBadUsage if the size of a non-empty array does not fit count rows.
void requireSizes(const HitArrays& arrays, std::size_t count);

/// Writes a row of the arrays of normals and positions, of which one may be empty.
void putVectors(const InstanceList& list, const RayRows& rays, std::size_t row, const RayHit& hit,
                const HitArrays& arrays);

/// Writes a row of all arrays that are not empty.
void putHit(const InstanceList& list, const RayRows& rays, std::size_t row, const RayHit& hit, const HitArrays& arrays);

} // namespace pointrt

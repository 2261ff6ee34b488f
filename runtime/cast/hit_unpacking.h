// SPDX-License-Identifier: Apache-2.0
// What the device says of hits, in the terms that were asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pointrt/trace.hpp"
#include "runtime/cast/ray_packing.h"

namespace pointrt {

/// In place of a target's number: nothing was met, or a shape of a scene file, with its number as the splat's.
constexpr std::uint32_t kNothing = 0xFFFFFFFFu, kShape = 0xFFFFFFFEu;

/// What a ray has met.
struct RayHit {
    double t = 0; ///< lengths of its direction
    std::uint32_t target = kNothing;
    std::uint32_t splat = 0;
    std::uint32_t normal = 0; ///< the splat's word that holds it
};

/// As the device found it against one target, between limits; a miss keeps `otherwise`.
RayHit hitOf(const gpu::CastHit& found, std::uint32_t target, const RayStart& start, const RayLimits& limits,
             const RayHit& otherwise);

/// Throws Error kBadUsage where an array that is asked for has no room for count rows, or too much.
void requireSizes(const HitArrays& arrays, std::size_t count);

/// Fills row of the arrays for normals and positions, of which one at least is asked for.
void putVectors(const TargetList& list, const RayRows& rays, std::size_t row, const RayHit& hit,
                const HitArrays& arrays);

/// Fills row of all arrays. list: what targets are numbers in
void putHit(const TargetList& list, const RayRows& rays, std::size_t row, const RayHit& hit, const HitArrays& arrays);

} // namespace pointrt

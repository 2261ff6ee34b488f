// SPDX-License-Identifier: Apache-2.0
// What the device says of hits, in the terms that were asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pointrt/trace.hpp"
#include "runtime/trace/ray_packing.h"

namespace pointrt {

/// Of the rays from number first on.
struct FoundHits {
    std::size_t first = 0;
    std::span<const gpu::CastHit> hits;
    std::span<const RayStart> starts;         ///< as many
    std::span<const std::uint32_t> instances; ///< number of the instance at each place on the device
};

/// Throws Error kBadUsage where an array that is asked for has no room for count rows, or too much.
void requireSizes(const HitArrays& arrays, std::size_t count);

void unpackHits(const FoundHits& found, const RayRows& rays, const RayLimits& limits, const HitArrays& arrays);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Rays that go to the device as callers have them, and come back as their hits: what lies between, the programs do
// (shaders/cast/given_rays.glsl). For scenes of one file, on devices that reckon in doubles.
#pragma once

#include <cstddef>
#include <span>

#include "runtime/cast/cast_slot.h"
#include "runtime/cast/hit_unpacking.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Whether device and target are such: the target is a file that nothing moves, whose buffers have one page each.
bool takesGiven(const Device& device, const PlacedTarget& target);

/// Rays of a caller where programs read them: in the caller's memory where the device shares the host's and can take it
/// as it is; else each chunk is copied to its slot.
class GivenRays {
public:
    /// @param rays stay as they are while this lives
    GivenRays(Device& device, const RayRows& rays);
    ~GivenRays() { destroyBuffer(device_, imported_); }
    GivenRays(const GivenRays&) = delete;
    GivenRays& operator=(const GivenRays&) = delete;

    /// Holds the rays from first on, so many, against the target; returns when what has come of them is in the slot.
    /// first is even.
    void trace(CastSlot& slot, CastPrograms& programs, const PlacedTarget& target, const RayLimits& limits,
               std::size_t first, std::size_t count, bool any_hit) const;

private:
    const std::byte* bytes() const {
        return rays_.doubles ? reinterpret_cast<const std::byte*>(rays_.doubles)
                             : reinterpret_cast<const std::byte*>(rays_.floats);
    }
    std::size_t bytesOf(std::size_t rays) const;
    void import();

    Device& device_;
    RayRows rays_;
    Buffer imported_;        ///< from the page on that they begin in
    std::size_t offset_ = 0; ///< of the first one there, bytes
};

/// What has come of so many rays: fills the rows of the arrays from first on. Target 0 of list is what they were held
/// against. False where one of them is for CastRounds to see to, and all of them have to be asked for once more: it is
/// no ray, or has numbers too large or too small for floats.
bool putGiven(const CastSlot& slot, const TargetList& list, const RayRows& rays, std::size_t first, std::size_t count,
              const HitArrays& arrays);
/// Likewise whether each is stopped.
bool putStopped(const CastSlot& slot, std::span<std::uint8_t> occluded);

} // namespace pointrt

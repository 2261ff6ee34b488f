// SPDX-License-Identifier: Apache-2.0
// Ray casts without packing and unpacking on the host: the device reads the caller's rays as they are
// (shaders/cast/given_rays.glsl). For scenes of one file, on devices with 64-bit floats.
#pragma once

#include <cstddef>
#include <span>

#include "runtime/cast/cast_slot.h"
#include "runtime/cast/hit_unpacking.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Whether given rays can be used: the device has 64-bit floats, the instance is a file with the identity transform,
/// and each of its buffers has one page.
bool takesGiven(const Device& device, const ResidentInstance& instance);

/// A caller's rays for programs to read: imported from the caller's memory if the device can do that, otherwise copied
/// to the slot of each chunk.
class GivenRays {
public:
    /// @param rays must outlive this, unchanged
    GivenRays(Device& device, const RayRows& rays);
    ~GivenRays() { destroyBuffer(device_, imported_); }
    GivenRays(const GivenRays&) = delete;
    GivenRays& operator=(const GivenRays&) = delete;

    /// Traces count rays, from first on, against the instance. Returns when the results are in the slot.
    /// @param first even
    void trace(CastSlot& slot, CastPrograms& programs, const ResidentInstance& instance, const RayLimits& limits,
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
    Buffer imported_;        ///< begins with the page in which the rays begin
    std::size_t offset_ = 0; ///< of the first ray in imported_, bytes
};

/// Writes the results of count rays to the arrays, from row first on; the rays were traced against instance 0 of list.
/// False if one of the rays is invalid, or too large or too small for floats: then all of them must be traced again,
/// with CastRounds.
bool putGiven(const CastSlot& slot, const InstanceList& list, const RayRows& rays, std::size_t first, std::size_t count,
              const HitArrays& arrays);
/// The same for occlusion: whether each ray is occluded.
bool putOccluded(const CastSlot& slot, std::span<std::uint8_t> occluded);

} // namespace pointrt

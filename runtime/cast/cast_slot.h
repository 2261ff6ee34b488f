// SPDX-License-Identifier: Apache-2.0
// The buffers for one chunk of rays and its hits. Several slots, each used by one thread, keep the device busy while
// other threads pack and unpack.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/cast/cast_programs.h"
#include "runtime/cast/ray_packing.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Consecutive rays of a chunk that are traced against one instance.
struct CastRun {
    const ResidentInstance* instance = nullptr;
    std::uint32_t first = 0, count = 0;
};

/// Plain data: free it with destroySlot, once.
struct CastSlot {
    /// Rays per chunk. 2048 workgroups fill any current device several times over; 17 MiB are transferred.
    static constexpr std::size_t kRays = 1u << 18;
    /// Limit for the runs of a chunk: each takes new descriptor sets.
    static constexpr std::size_t kRuns = 64;

    Device device; ///< a worker of the scene's device
    Buffer rays;   ///< gpu::CastRay, or the caller's rays
    Buffer hits;   ///< gpu::CastHit, or gpu::GivenHit
    Buffer occluded;
    std::vector<RayStart> starts;

    /// The rays and results of a chunk of count rays.
    std::span<gpu::CastRay> rayRows(std::size_t count);
    std::span<std::byte> givenBytes() { return {static_cast<std::byte*>(rays.mapped), rays.bytes}; }
    std::span<const gpu::GivenHit> givenHits(std::size_t count) const;
    std::span<const gpu::CastHit> hitRows(std::size_t count) const;
    std::span<const std::uint32_t> occludedRows(std::size_t count) const; ///< 0: not occluded
};

/// Throws Error kCannotRun if out of memory.
CastSlot createSlot(Device& device);
void destroySlot(CastSlot& slot);

/// Traces a caller's rays, which the buffer rays holds, against one instance. Returns when the results are in the slot.
/// @param form not kPacked
void traceRows(CastSlot& slot, CastPrograms& programs, const ResidentInstance& instance, const Buffer& rays,
               RayForm form, const gpu::GivenPush& push, bool any_hit);

/// Traces at most kRuns runs, each ray against the instance of its run. Returns when the results are in the slot.
void traceSlot(CastSlot& slot, CastPrograms& programs, std::span<const CastRun> runs, bool any_hit);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Room for one chunk of rays on its way to the device and back. Several of them, each used by a thread of its own, keep
// the device at work while others are packed and unpacked.
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

/// Rows of a chunk that are held against one target.
struct CastRun {
    const PlacedTarget* target = nullptr;
    std::uint32_t first = 0, count = 0;
};

/// Plain data: free it with destroySlot, once.
struct CastSlot {
    /// Rays of a chunk. 2048 workgroups fill any device of today several times; 17 MiB go back and forth.
    static constexpr std::size_t kRays = 1u << 18;
    /// Runs of a chunk, at most: what they bind is made anew for each chunk.
    static constexpr std::size_t kRuns = 64;

    Device device; ///< a worker of the scene's
    Buffer rays;   ///< gpu::CastRay, or rows as callers have them
    Buffer hits;   ///< gpu::CastHit, or gpu::GivenHit
    Buffer stopped;
    std::vector<RayStart> starts;

    /// Of a chunk of count rays: where they are put, and what has come of them.
    std::span<gpu::CastRay> rayRows(std::size_t count);
    std::span<std::byte> givenBytes() { return {static_cast<std::byte*>(rays.mapped), rays.bytes}; }
    std::span<const gpu::GivenHit> givenHits(std::size_t count) const;
    std::span<const gpu::CastHit> hitRows(std::size_t count) const;
    std::span<const std::uint32_t> stoppedRows(std::size_t count) const; ///< 0 where nothing is in the way
};

/// Throws Error kCannotRun where memory lacks.
CastSlot createSlot(Device& device);
void destroySlot(CastSlot& slot);

/// Traces rows as callers have them, which lie in rays, all against one target, and returns likewise. form: not kPacked
void traceRows(CastSlot& slot, CastPrograms& programs, const PlacedTarget& target, const Buffer& rays, RayForm form,
               const gpu::GivenPush& push, bool any_hit);

/// Traces at most kRuns runs, each ray against its run's target alone; returns when what came of them is there.
void traceSlot(CastSlot& slot, CastPrograms& programs, std::span<const CastRun> runs, bool any_hit);

} // namespace pointrt

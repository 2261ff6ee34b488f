// SPDX-License-Identifier: Apache-2.0
// Room for one chunk of rays on its way to the device and back. Several of them, each used by a thread of its own, keep
// the device at work while others are packed and unpacked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/trace/cast_programs.h"
#include "runtime/trace/ray_packing.h"

namespace pointrt {

/// Plain data: free it with destroySlot, once.
struct CastSlot {
    /// Rays of a chunk. 2048 workgroups fill any device of today several times; 17 MiB go back and forth.
    static constexpr std::size_t kRays = 1u << 18;

    Device device; ///< a worker of the scene's
    Buffer rays, hits, stopped;
    std::vector<RayStart> starts;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<DescriptorSets> sets; ///< of each instance, in the scene's order

    /// Of a chunk of count rays: where they are put, and what has come of them.
    std::span<gpu::CastRay> rayRows(std::size_t count);
    std::span<const gpu::CastHit> hitRows(std::size_t count) const;
    std::span<const std::uint32_t> stoppedRows(std::size_t count) const; ///< 0 where nothing is in the way
};

/// Throws Error kCannotRun where memory lacks.
CastSlot createSlot(Device& device, const DeviceScene& scene, const CastPrograms& programs);
void destroySlot(CastSlot& slot);

/// Traces the slot's first count rays through all instances; returns when what came of them is there.
void traceSlot(CastSlot& slot, const DeviceScene& scene, const CastPrograms& programs, std::size_t count, bool any_hit);

} // namespace pointrt

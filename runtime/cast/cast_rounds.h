// SPDX-License-Identifier: Apache-2.0
// Traces rays from instance to instance. Each ray visits the instances whose boxes it enters, nearest first, until it
// has a hit before the next box begins. Thus each ray visits few instances, however many there are. Rays that wait for
// the same instance are traced together. Instances that are not resident are loaded in the order of the number of rays
// that wait for them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/cast/hit_unpacking.h"
#include "runtime/cast/instance_residency.h"
#include "runtime/cast/instance_tree.h"
#include "runtime/cast/slot_pool.h"

namespace pointrt {

/// The scene that rays are traced in.
struct CastScene {
    InstanceResidency& resident;
    const InstanceTree& tree; ///< over the boxes of the instances
    CastPrograms& programs;
    SlotPool& slots;
};

struct CastRequest {
    RayRows rays;
    RayLimits limits;
    bool any_hit = false; ///< occlusion only: t and splat of a hit are not set
};

/// Traces consecutive rays of a request. For one thread.
class CastRounds {
public:
    CastRounds(const CastScene& scene, const CastRequest& request, std::size_t first, std::size_t count);

    /// The hit of each ray. Throws RayError if a ray is invalid, and Error as InstanceResidency::load.
    std::vector<RayHit> run();

private:
    /// The number of rays that wait for an instance.
    struct Queue {
        std::uint32_t instance = 0, count = 0;
    };
    void begin(std::size_t ray);
    void finish(std::size_t ray);
    std::vector<Queue> queuesOf(const std::vector<std::uint32_t>& waiting);
    void loadFor(std::vector<Queue> queues);
    std::vector<std::uint32_t> takeReady(std::vector<std::uint32_t>& waiting, const std::vector<Queue>& ready);
    void trace(const std::vector<std::uint32_t>& rows, const std::vector<Queue>& queues);
    void traceChunk(CastSlot& slot, std::span<const std::uint32_t> rows, std::span<const CastRun> runs);
    void finishStep(CastSlot& slot, std::uint32_t ray, std::size_t row);
    RayLimits limitsOf(std::uint32_t ray, double size) const;

    CastScene scene_;
    CastRequest request_;
    std::size_t first_;
    std::vector<RayHit> hits_;           ///< so far; t in lengths of the scaled direction, for a miss the ray's end
    std::vector<BoxEntry> entries_;      ///< the next box of each ray
    std::vector<std::uint32_t> waiting_; ///< number of rays that wait for each instance; 0 between calls
};

} // namespace pointrt

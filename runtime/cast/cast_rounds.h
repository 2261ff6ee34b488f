// SPDX-License-Identifier: Apache-2.0
// Rays from target to target. Each asks the targets whose boxes it comes into, nearest first, until it has hit
// something before the next box begins; those that wait for the same target go through it together. So each ray asks
// few targets, however many there are, and where they come and go those are brought that most rays wait for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/cast/hit_unpacking.h"
#include "runtime/cast/resident_targets.h"
#include "runtime/cast/slot_pool.h"
#include "runtime/cast/target_tree.h"

namespace pointrt {

/// What rays go through.
struct CastScene {
    ResidentTargets& resident;
    const TargetTree& tree; ///< of the targets' boxes
    CastPrograms& programs;
    SlotPool& slots;
};

struct CastRequest {
    RayRows rays;
    RayLimits limits;
    bool any_hit = false; ///< only whether there is one: its t and its splat mean nothing
};

/// Of some rays, one behind the other. For one thread.
class CastRounds {
public:
    CastRounds(const CastScene& scene, const CastRequest& request, std::size_t first, std::size_t count);

    /// What has become of each. Throws RayError for one that is none, and Error as ResidentTargets::bring.
    std::vector<RayHit> run();

private:
    /// Those that wait for a target, as numbers from first on.
    struct Queue {
        std::uint32_t target = 0, count = 0;
    };
    void begin(std::size_t ray);
    void finish(std::size_t ray);
    std::vector<Queue> queuesOf(const std::vector<std::uint32_t>& waiting);
    void bringFor(std::vector<Queue> queues);
    std::vector<std::uint32_t> takeReady(std::vector<std::uint32_t>& waiting, const std::vector<Queue>& ready);
    void trace(const std::vector<std::uint32_t>& rows, const std::vector<Queue>& queues);
    void traceChunk(CastSlot& slot, std::span<const std::uint32_t> rows, std::span<const CastRun> runs);
    void settle(CastSlot& slot, std::uint32_t ray, std::size_t row);
    RayLimits limitsOf(std::uint32_t ray, double size) const;

    CastScene scene_;
    CastRequest request_;
    std::size_t first_;
    std::vector<RayHit> hits_; ///< so far; t is in scaled lengths, and how far the ray goes where it met nothing
    std::vector<Stop> stops_;  ///< what each ray asks next
    std::vector<std::uint32_t> waiting_; ///< of each target
};

} // namespace pointrt

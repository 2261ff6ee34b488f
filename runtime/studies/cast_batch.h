// SPDX-License-Identifier: Apache-2.0
// Rays collected one by one, cast together.
#pragma once

#include <span>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// Rays with directions of unit length. Reuse it for the next batch: its memory is kept.
class CastBatch {
public:
    void clear() { numbers_.clear(); }
    void add(Vec3 origin, Vec3 direction) {
        numbers_.insert(numbers_.end(), {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z});
    }
    std::size_t size() const { return numbers_.size() / 6; }

    /// The distance of each ray's first hit; infinite for a miss. Valid until the next call.
    std::span<const double> cast(const TraceScene& scene, const RayLimits& limits = {}) {
        distances_.resize(size());
        scene.castRays(std::span<const double>(numbers_), limits, {.t_hit = distances_});
        return distances_;
    }

private:
    std::vector<double> numbers_, distances_;
};

} // namespace pointrt

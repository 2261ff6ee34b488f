// SPDX-License-Identifier: Apache-2.0
// From hits of a pulse's rays to the points that a scanner records.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/studies/pulse_rays.h"
#include "runtime/studies/returns.h"

namespace pointrt {

/// Hits of one pulse's rays, as from castRays, with their reflectances.
struct PulseHits {
    std::span<const double> t;
    std::span<const std::uint32_t> splat_ids, instance_ids;
    std::span<const std::uint32_t> tile_ids; ///< empty for scenes without tile sets
    std::span<const float> normals;          ///< [rays][3]
    std::span<const float> reflectances;
};

/// Measures pulses: combines rays into returns, and applies the detection threshold, noise and the selection of
/// returns. Use one per thread.
class LidarReceiver {
public:
    /// sensor is valid (sensor_check.h) and outlives the receiver.
    LidarReceiver(const LidarSensor& sensor, std::uint64_t seed, double metres_per_unit);

    /// Appends the returns of a pulse to points.
    void receive(const FiredPulse& pulse, const PulseHits& hits, LidarPoints& points);

private:
    void collectEchoes(const FiredPulse& pulse, const PulseHits& hits);
    void selectReturns();
    void append(const FiredPulse& pulse, std::size_t number, bool has_tiles, LidarPoints& points) const;

    const LidarSensor& sensor_;
    LidarRandom random_;
    double metres_per_unit_;
    double reference_range_;
    std::vector<RayEcho> echoes_;
    std::vector<LidarReturn> returns_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Pulses of a run as rays.
#pragma once

#include <cstdint>
#include <span>

#include "pointrt/lidar.hpp"
#include "runtime/studies/pattern.h"
#include "runtime/studies/philox.h"
#include "runtime/studies/spot.h"
#include "runtime/studies/trajectory.h"

namespace pointrt {

/// A pulse on its way, in the scan's coordinates.
struct LidarShot {
    std::uint64_t number = 0;
    double time = 0;
    Vec3 origin, axis;
    std::uint16_t ring = 0;
    float scan_angle_deg = 0;
};

/// Where a run's pulses go. Threads may use it at the same time.
class LidarAim {
public:
    /// sensor and run hold what they should (check.h).
    LidarAim(const LidarSensor& sensor, const LidarRun& run);

    std::size_t raysPerPulse() const { return spot_.size(); }
    LidarShot shot(std::uint64_t number) const;
    /// The shot's rays, six numbers each: raysPerPulse of them.
    void rays(const LidarShot& shot, std::span<double> numbers) const;

private:
    const LidarPattern& pattern_;
    LidarPath path_;
    LidarSpot spot_;
    LidarRandom random_;
    double start_s_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Which way each pulse of a scanner goes, and when.
#pragma once

#include <cstdint>

#include "pointrt/lidar.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// A pattern fires again and again: so many pulses each period.
struct FiringTimes {
    double period_s = 0;
    std::uint64_t pulses = 0;
    double cycle_s = 0; ///< until all directions have come once: a turn, a frame, there and back
};

FiringTimes firingTimes(const LidarPattern& pattern);

struct LidarPulse {
    double delay_s = 0; ///< behind the run's start
    Vec3 direction;     ///< unit length, scanner's frame
    std::uint16_t ring = 0;
    float scan_angle_deg = 0;
};

/// The pulse of this number, from 0.
LidarPulse pulseOf(const LidarPattern& pattern, std::uint64_t number);

} // namespace pointrt

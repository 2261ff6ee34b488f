// SPDX-License-Identifier: Apache-2.0
// Direction and time of each pulse of a scan pattern.
#pragma once

#include <cstdint>

#include "pointrt/lidar.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// A pattern repeats: it fires pulses pulses in each period.
struct FiringTimes {
    double period_s = 0;
    std::uint64_t pulses = 0;
    double cycle_s = 0; ///< until all directions have occurred: a rotation, a frame, or a sweep and back
};

FiringTimes firingTimes(const LidarPattern& pattern);

struct LidarPulse {
    double delay_s = 0; ///< after the start of the run
    Vec3 direction;     ///< unit length, in the scanner's frame
    std::uint16_t ring = 0;
    float scan_angle_deg = 0;
};

/// @param number of the pulse, from 0
LidarPulse pulseOf(const LidarPattern& pattern, std::uint64_t number);

} // namespace pointrt

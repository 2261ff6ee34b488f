// SPDX-License-Identifier: Apache-2.0
// Sensors and runs that are none are refused before anything is done.
#pragma once

#include "pointrt/lidar.hpp"

namespace pointrt {

/// Each throws TraceError kBadUsage with the first thing that is wrong, by its name in lidar.hpp.
void requireSensor(const LidarSensor& sensor);
void requireTrajectory(const std::vector<LidarPose>& trajectory);
/// The trajectory, and whether times lie on it.
void requireRun(const LidarRun& run);

} // namespace pointrt

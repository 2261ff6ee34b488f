// SPDX-License-Identifier: Apache-2.0
// Validates sensors and runs before any work.
#pragma once

#include "pointrt/lidar.hpp"

namespace pointrt {

/// Each throws TraceError kBadUsage that names the first invalid member, as in lidar.hpp.
void requireSensor(const LidarSensor& sensor);
void requireTrajectory(const std::vector<LidarPose>& trajectory);
/// Also validates the trajectory, and that the times lie within it.
void requireRun(const LidarRun& run);

} // namespace pointrt

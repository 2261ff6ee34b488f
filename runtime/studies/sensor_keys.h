// SPDX-License-Identifier: Apache-2.0
// The parts of a sensor file that have files of their own.
#pragma once

#include <string>
#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/scene_io/values.h"

namespace pointrt {

/// The one of [spinning], [flash], [oscillating] and [table] that the file has.
LidarPattern readPattern(const SceneValue& file);
/// Names of those tables.
std::vector<std::string_view> patternTables();

/// Beams of a text file: columns azimuth_deg and elevation_deg, and ring and delay_s where there are any. Throws Error
/// kBadInput "FILE[:LINE]: reason".
std::vector<LidarBeam> readBeams(const std::string& path);
/// As readLidarTrajectory, but throws Error.
std::vector<LidarPose> readPoses(const std::string& path);

/// The file that value names, beside the one that it stands in.
std::string besideOf(const SceneValue& value);

} // namespace pointrt

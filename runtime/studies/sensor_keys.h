// SPDX-License-Identifier: Apache-2.0
// Parts of the reader of sensor files.
#pragma once

#include <string>
#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/scene_io/values.h"

namespace pointrt {

/// Reads the pattern: exactly one of the tables [spinning], [flash], [oscillating] and [table].
LidarPattern readPattern(const SceneValue& file);
/// The names of these tables.
std::vector<std::string_view> patternTables();

/// Reads a text file of beams with the columns azimuth_deg, elevation_deg and optionally ring and delay_s. Throws Error
/// kBadInput "FILE[:LINE]: reason".
std::vector<LidarBeam> readBeams(const std::string& path);
/// readLidarTrajectory that throws Error.
std::vector<LidarPose> readPoses(const std::string& path);

/// The path that value names, relative to the file that contains value.
std::string relativePath(const SceneValue& value);

} // namespace pointrt

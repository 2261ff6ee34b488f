// SPDX-License-Identifier: Apache-2.0
// Parts of a profile.
#pragma once

#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// Whether a station has several surfaces.
bool hasLayers(const std::vector<ProfilePoint>& points);

/// Consecutive points that are hit.
std::vector<std::vector<ProfilePoint>> profileRuns(const std::vector<ProfilePoint>& points);

} // namespace pointrt

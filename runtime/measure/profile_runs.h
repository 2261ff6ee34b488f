// SPDX-License-Identifier: Apache-2.0
// Parts of a profile.
#pragma once

#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// Whether any station has several surfaces.
bool hasLayers(const std::vector<ProfilePoint>& points);

/// Runs of consecutive points that are hits.
std::vector<std::vector<ProfilePoint>> profileRuns(const std::vector<ProfilePoint>& points);

} // namespace pointrt

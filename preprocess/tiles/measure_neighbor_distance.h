// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the distance of a set's points to their neighbours.
#pragma once

#include <optional>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// CloudStatistics::common_reach of a set whose points are split, from about 65,000 samples in all tiles or, above 32
/// million points, in every n-th tile. nullopt for fewer than kMinPointsForOutliers points. Throws Error as readPoints
/// does.
std::optional<float> measureNeighborDistance(const SetPlan& plan);

} // namespace pointrt

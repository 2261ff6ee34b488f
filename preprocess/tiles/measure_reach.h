// SPDX-License-Identifier: GPL-3.0-or-later
// How far the points of a set reach to their neighbours.
#pragma once

#include <optional>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// CloudTraits::common_reach of a set whose points are split, told by some 65,000 of them: of all tiles, or of every so
/// manieth where they have more than 32 million points. None of sets of fewer than kFewForStrays points. Throws Error
/// as readPoints does.
std::optional<float> measureReach(const SetPlan& plan);

} // namespace pointrt

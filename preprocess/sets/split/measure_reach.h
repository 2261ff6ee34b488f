// SPDX-License-Identifier: GPL-3.0-or-later
// How far the points of a set reach to their neighbours.
#pragma once

#include <optional>

#include "preprocess/sets/plan.h"

namespace pointrt {

/// CloudTraits::common_reach of a set whose points are split, of some 65,000 of the points of 32 tiles at most, at even
/// steps; none where no tile has two points. Throws Error as readPoints does.
std::optional<float> measureReach(const SetPlan& plan);

} // namespace pointrt

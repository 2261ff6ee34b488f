// SPDX-License-Identifier: GPL-3.0-or-later
// How noisy the scans of a set are: decided once, so that no tile is smoothed beside one that is not.
#pragma once

#include <vector>

#include "preprocess/sets/plan.h"

namespace pointrt {

/// [scans], as SurfaceReport::noise, of a few places that lie at even steps among all points: the median of those where
/// a scan has points enough, and of scans that have none there the median of all others. Empty where no place has
/// enough. The points are split. Throws Error as readBucket does.
std::vector<float> measureNoise(const SetPlan& plan);

} // namespace pointrt

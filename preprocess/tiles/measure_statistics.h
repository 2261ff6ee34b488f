// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of all points of a set, measured once, so that adjacent tiles are smoothed, filled or scattered alike.
#pragma once

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Measures a few places at even steps among all points, which must be split. Noise, if points are to be cleaned: the
/// median over the places where a scan has enough points; for scans without such a place the median of all; empty if no
/// place has enough. Other values: from all places together (StatisticsSampler). Throws Error as readBucket does.
CloudStatistics measureStatistics(const SetPlan& plan);

} // namespace pointrt

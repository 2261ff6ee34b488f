// SPDX-License-Identifier: GPL-3.0-or-later
// What only all points of a set tell: decided once, so that no tile is smoothed, filled or scattered beside one that is
// not.
#pragma once

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Of a few places that lie at even steps among all points. Noise, where points are to be cleaned: the median of those
/// places where a scan has points enough, and of scans that have none there the median of all others; empty where no
/// place has enough. The rest: what all places together tell (PlacesOfCloud). The points are split. Throws Error as
/// readBucket does.
CloudTraits measureTraits(const SetPlan& plan);

} // namespace pointrt

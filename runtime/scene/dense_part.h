// SPDX-License-Identifier: Apache-2.0
// The part of a site that its scan shows best.
#pragma once

#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// A sample without the sparse outskirts of a site. A lidar's points thin out with distance: the outermost tenth may
/// take up two thirds of the width. Keeps at least nine tenths of the splats: those up to the horizontal distance from
/// the middle beyond which hardly any are added. Evenly spaced samples, such as corridors, and samples below
/// kEachCounts are kept whole.
/// @param sample without strays
/// @param up unit length
SceneSample densePart(const SceneSample& sample, Vec3 up);

} // namespace pointrt

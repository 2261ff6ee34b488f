// SPDX-License-Identifier: Apache-2.0
// The part of a site that its scan shows best.
#pragma once

#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// A sample without the thin surroundings of a site. A lidar's points lie ever farther apart with the distance: the
/// last tenth of them may be on two thirds of the width. Keeps the splats around their middle, at least nine tenths of
/// them, up to the horizontal distance beyond which their share hardly grows. Even samplings, corridors among them, and
/// samples below kEachCounts are kept whole.
/// @param sample without strays
/// @param up unit length
SceneSample densePart(const SceneSample& sample, Vec3 up);

} // namespace pointrt

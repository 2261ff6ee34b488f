// SPDX-License-Identifier: Apache-2.0
// What a picked point is, in the words of the scan it is of.
#pragma once

#include "runtime/staged_scene.h"
#include "runtime/window/live_picture.h"
#include "runtime/window/workspace.h"

namespace pointrt {

/// position and normal as the file has them, before the scene placed it; of shapes, as the scene has them.
PickedPoint describePick(const StagedScene& scene, const Pick& pick);

} // namespace pointrt

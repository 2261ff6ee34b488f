// SPDX-License-Identifier: Apache-2.0
// What a picked point is, in the words of the scan it is of.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/pick.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// position and normal as the file has them, before the scene placed it; of shapes, as the scene has them.
PickedPoint describePick(const DeviceScene& scene, const Pick& pick);

} // namespace pointrt

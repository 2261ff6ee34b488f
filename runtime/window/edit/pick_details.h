// SPDX-License-Identifier: Apache-2.0
// Properties of a picked point, in its scan's coordinates.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/pick.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Position and normal are in the file's coordinates for scans, in the scene's for shapes.
PickedPoint describePick(const DeviceScene& scene, const Pick& pick);

} // namespace pointrt

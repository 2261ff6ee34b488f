// SPDX-License-Identifier: Apache-2.0
// Picks that become measurements of the scene.
#pragma once

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Adds the path through the picks to the scene and clears the picks. False if there are fewer than two picks.
bool keepMeasurement(Workspace& work);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Measures the path through the picked points.
#pragma once

#include <vector>

#include "runtime/measure/path_files.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// picks: at least two. up: unit length.
MeasuredPath pickedPath(const std::vector<PickedPoint>& picks, Vec3 up);

} // namespace pointrt

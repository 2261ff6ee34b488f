// SPDX-License-Identifier: Apache-2.0
// Where points of the scene appear in the window.
#pragma once

#include <imgui.h>

#include <optional>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// The place in window units. None if the point is behind the eye, or too far outside for float precision.
std::optional<ImVec2> onScreen(const Workspace& w, Vec3 point);

} // namespace pointrt

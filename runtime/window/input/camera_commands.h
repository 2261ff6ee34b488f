// SPDX-License-Identifier: Apache-2.0
// What commands do to the camera.
#pragma once

#include <optional>

#include "runtime/window/input/commands.h"
#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// Where camera stands after a drag or a turn of the wheel; nothing where the command is no such thing. size: of the
/// window.
std::optional<ViewCamera> cameraAfter(const Command& command, const ViewCamera& camera, ViewSize size);

/// Where an action takes camera, in a flight; nothing where it takes it nowhere. home: where the window began.
std::optional<ViewCamera> cameraForAction(Action action, const ViewCamera& camera, const ViewCamera& home);

} // namespace pointrt

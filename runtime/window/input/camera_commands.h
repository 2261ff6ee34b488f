// SPDX-License-Identifier: Apache-2.0
// Effects of commands on the camera.
#pragma once

#include <optional>

#include "runtime/window/input/commands.h"
#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// The camera after a drag or a scroll; none for other commands. size: of the window.
std::optional<ViewCamera> cameraAfter(const Command& command, const ViewCamera& camera, ViewSize size);

/// Where an action flies the camera to; none if it is not a camera action. home: the initial camera. size: of the
/// window.
std::optional<ViewCamera> cameraForAction(Action action, const ViewCamera& camera, const ViewCamera& home,
                                          ViewSize size);

} // namespace pointrt

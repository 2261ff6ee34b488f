// SPDX-License-Identifier: Apache-2.0
// What keys do to the workspace: what they show, and what they ask for.
#pragma once

#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/controls.h"

namespace pointrt {

/// False, with nothing done, where the action is of something else: the camera, the clipboard, other files.
bool applyAction(Workspace& work, Action action);

} // namespace pointrt

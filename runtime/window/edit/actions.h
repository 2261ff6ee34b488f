// SPDX-License-Identifier: Apache-2.0
// Actions of keys on the workspace.
#pragma once

#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/controls.h"

namespace pointrt {

/// Returns false and does nothing for actions that are handled elsewhere: camera, clipboard, opening other files.
bool applyAction(Workspace& work, Action action);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// What is on the screen as a scene that can be saved.
#pragma once

#include "runtime/window/edit/workspace.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// What renders the picture on the screen, of that size, headless.
SceneDescription sceneAsShown(const Workspace& work, PixelSize size);

/// Keeps the view in the scene, under work.view_name or a number that is free, in place of one that has this name.
void saveView(Workspace& work);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The displayed scene as a scene description, to save it.
#pragma once

#include "runtime/window/edit/workspace.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// A description that renders the displayed picture, of this size, headless.
SceneDescription sceneAsShown(const Workspace& work, PixelSize size);

/// Saves the camera as a view named work.view_name, or "view N" if that is empty. Replaces a view of the same name.
void saveView(Workspace& work);

} // namespace pointrt

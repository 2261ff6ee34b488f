// SPDX-License-Identifier: Apache-2.0
// The whole user interface.
#pragma once

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Of the panel at the right of a window of this width, in window units; scale: of the interface.
float panelWidth(float window_width, float scale);

/// Between ImGui::NewFrame and ImGui::Render, after setUpUiStyle (ui_style.h): shows what w says, and writes to it what
/// the user did. Takes any numbers in w; indices of materials must be there.
void drawUi(Workspace& w);

} // namespace pointrt

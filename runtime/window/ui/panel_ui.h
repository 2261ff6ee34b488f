// SPDX-License-Identifier: Apache-2.0
// The user interface.
#pragma once

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Width of the panel, window units. scale: of the interface.
float panelWidth(float window_width, float scale);

/// Call it between ImGui::NewFrame and ImGui::Render, after setUpUiStyle (ui_style.h). Draws the interface for w and
/// writes the user's requests to it. Any numbers in w are safe, but material indices must be valid.
void drawUi(Workspace& w);

} // namespace pointrt

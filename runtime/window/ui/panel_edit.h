// SPDX-License-Identifier: Apache-2.0
// From a widget that was just used to what the window is asked for.
#pragma once

#include <cstdint>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// What an edit is of; bits.
enum class Edit : std::uint8_t { kScene = 1, kSettings = 2, kLook = 4 };

/// Right after a widget, or a group of them: asks for what its edit takes. Returns changed.
bool reportEdit(Requests& requests, Edit edit, bool changed);

/// Once a frame, outside of all windows, after all widgets: an edit that was under way and has ended is asked for once
/// more, no longer as dragging.
void endEdits(Requests& requests);

/// Numbers that belong to the panel alone (what is selected, the sun's date) live with ImGui under a name, and begin as
/// fallback. The reference is good until the next call; calls go outside of other ids.
int& storedInt(const char* name, int fallback);
float& storedFloat(const char* name, float fallback);

} // namespace pointrt

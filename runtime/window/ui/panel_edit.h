// SPDX-License-Identifier: Apache-2.0
// Reports edits made with widgets to the window.
#pragma once

#include <cstdint>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// What was edited, as bits.
enum class Edit : std::uint8_t { kScene = 1, kSettings = 2, kLook = 4 };

/// Call it after a widget or a group of widgets. If changed, requests the update for this edit. Returns changed.
bool reportEdit(Requests& requests, Edit edit, bool changed);

/// The same for edits of the scene.
inline bool reportSceneEdit(Workspace& w, bool changed) { return reportEdit(w.requests, Edit::kScene, changed); }

/// Call it once per frame, outside all windows and after all widgets: repeats the request of an edit that has just
/// ended, with dragging off.
void endEdits(Requests& requests);

/// Values of the panel's own state (selection, the sun's date), stored in ImGui under a name. The reference is valid
/// until the next call. Call it outside other ids.
int& storedInt(const char* name, int fallback);
float& storedFloat(const char* name, float fallback);

} // namespace pointrt

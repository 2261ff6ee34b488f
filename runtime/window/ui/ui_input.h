// SPDX-License-Identifier: Apache-2.0
// Feeds input events to Dear ImGui.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/window/input/events.h"
#include "runtime/window/platform/platform.h"

namespace pointrt {

/// ImGui samples keys and buttons once per frame, so a release in the same frame as its press is delayed to the next
/// frame.
struct UiInput {
    std::array<bool, 3> pressed{}, released{}; ///< buttons, in this frame
    std::vector<Key> pressed_keys, released_keys;
};

/// ImGui's number of the key. With recent versions of ImGui, ImGuiKey_None unless the key is used to edit text.
ImGuiKey uiKey(Key key);

/// Sets up the current ImGui context's keys for text editing. Once, before the first event.
void setUpUiInput();

/// Feeds an event to the current ImGui context. Ignores sizes, dropped files and closing.
void feedImGui(UiInput& input, const InputEvent& event);

/// Calls ImGui::NewFrame for a window of this size, seconds (above 0) after the last frame.
void beginUiFrame(UiInput& input, const ResizeEvent& size, double seconds);

/// Closes the topmost open list, colour picker or menu. False if none is open; a question stays.
bool closePopup();

/// The mouse cursor's shape over the UI; call it after ImGui::Render.
CursorShape uiCursor();

/// Connects ImGui to the desktop's clipboard. window must not move while the context exists.
void useClipboard(PlatformWindow& window);

} // namespace pointrt

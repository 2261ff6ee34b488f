// SPDX-License-Identifier: Apache-2.0
// Input events for Dear ImGui.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/window/input/events.h"
#include "runtime/window/platform/platform.h"

namespace pointrt {

/// What ImGui, which looks at keys and buttons once a frame, must not miss: whatever goes down and up again within a
/// frame is up in the next one.
struct UiInput {
    std::array<bool, 3> pressed{}, released{}; ///< buttons, since the last frame
    std::vector<Key> pressed_keys, released_keys;
};

/// The number that ImGui's questions about a key take; newer ImGui has ImGuiKey_None for those it does not edit text
/// with.
ImGuiKey uiKey(Key key);

/// Tells the current ImGui context which keys it edits text with. Once, before the first event.
void setUpUiInput();

/// Hands an event to the current ImGui context. Sizes, dropped files and closing are none of its business.
void feedImGui(UiInput& input, const InputEvent& event);

/// ImGui::NewFrame for a window of size, seconds (above 0) after the last one.
void beginUiFrame(UiInput& input, const ResizeEvent& size, double seconds);

/// The shape that the mouse cursor should have over the UI; after ImGui::Render.
CursorShape uiCursor();

/// ImGui copies and pastes with the desktop; window stays where it is until the context is gone.
void useClipboard(PlatformWindow& window);

} // namespace pointrt

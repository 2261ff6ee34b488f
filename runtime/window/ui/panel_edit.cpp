// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_edit.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace pointrt {
namespace {

/// Storage of ImGui's fallback window, which always exists.
ImGuiStorage& storage() { return ImGui::FindWindowByName("Debug##Default")->StateStorage; }

/// Edits in progress at the end of the last frame.
int& activeEdits() { return storedInt("edits under way", 0); }

bool& flagOf(Requests& requests, Edit edit) {
    if (edit == Edit::kScene) return requests.scene_changed;
    return edit == Edit::kSettings ? requests.settings_changed : requests.look_changed;
}

} // namespace

bool reportEdit(Requests& requests, Edit edit, bool changed) {
    const int bit = static_cast<int>(edit);
    const bool held = ImGui::IsItemActive();
    if (changed) flagOf(requests, edit) = true;
    if (held && (changed || (activeEdits() & bit) != 0)) {
        requests.dragging = true;
        activeEdits() |= bit;
    }
    return changed;
}

void endEdits(Requests& requests) {
    if (requests.dragging || activeEdits() == 0) return;
    for (const Edit edit : {Edit::kScene, Edit::kSettings, Edit::kLook})
        if ((activeEdits() & static_cast<int>(edit)) != 0) flagOf(requests, edit) = true;
    activeEdits() = 0;
}

int& storedInt(const char* name, int fallback) { return *storage().GetIntRef(ImHashStr(name), fallback); }

float& storedFloat(const char* name, float fallback) { return *storage().GetFloatRef(ImHashStr(name), fallback); }

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_box.h"

namespace pointrt {

float boxOnPicture(const char* name, const BoxPlace& place, float width, ImGuiWindowFlags flags,
                   const std::function<void()>& content) {
    ImGui::SetNextWindowPos(place.at, ImGuiCond_Always, place.pivot);
    ImGui::SetNextWindowSize(ImVec2(width, 0));
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | flags);
    content();
    const float height = ImGui::GetWindowHeight();
    ImGui::End();
    return height;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Views section: saved views.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kGoWidth = 34, kDeleteWidth = 58;

bool isFreeName(const SceneDescription& scene, const std::string& name) {
    return !name.empty() && std::none_of(scene.views.begin(), scene.views.end(),
                                         [&](const NamedView& view) { return view.name == name; });
}

/// A row with the view's name, which can be edited, and buttons. A typed name applies as soon as it is unused and not
/// empty.
void drawView(Workspace& w, std::size_t number) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, scale = uiScale();
    ImGui::PushID(static_cast<int>(number));
    if (ImGui::Button("Go", ImVec2(kGoWidth * scale, 0))) w.requests.go_to_view = number;
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(std::max(1.0f, ImGui::GetContentRegionAvail().x - kDeleteWidth * scale - gap));
    std::string name = w.scene.views[number].name;
    if (ImGui::InputText("##name", &name) && isFreeName(w.scene, name)) w.scene.views[number].name = name;
    tooltip("click to rename");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Delete", ImVec2(kDeleteWidth * scale, 0))) w.requests.delete_view = number;
    ImGui::PopID();
}

} // namespace

void drawViews(Workspace& w) {
    for (std::size_t v = 0; v < w.scene.views.size(); ++v) drawView(w, v);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, width = kDeleteWidth * uiScale();
    ImGui::SetNextItemWidth(std::max(1.0f, ImGui::GetContentRegionAvail().x - width - gap));
    ImGui::InputTextWithHint("##new", "name of the new view", &w.view_name);
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Save", ImVec2(width, 0))) w.requests.save_view = true;
    tooltip("V: save the current view; it is stored in the scene file");
}

} // namespace pointrt

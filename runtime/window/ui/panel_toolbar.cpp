// SPDX-License-Identifier: Apache-2.0
// The toolbar: the actions that most sessions need.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "runtime/window/input/controls.h"
#include "runtime/window/ui/panel_box.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

struct ToolButton {
    Action action;
    const char* label;
    bool (*is_enabled)(const Workspace&);
    bool (*is_on)(const Workspace&); ///< shown as pressed; null: never
};

constexpr ToolButton kButtons[] = {
    {Action::kOpen, "Open", [](const Workspace&) { return true; }, nullptr},
    {Action::kSaveScene, "Save", hasScene, nullptr},
    {Action::kUndo, "Undo", [](const Workspace& w) { return w.can_undo; }, nullptr},
    {Action::kRedo, "Redo", [](const Workspace& w) { return w.can_redo; }, nullptr},
    {Action::kHome, "Home", hasScene, nullptr},
    {Action::kTopView, "Top", hasScene, nullptr},
    {Action::kOrthographic, "Ortho", hasScene, [](const Workspace& w) { return w.camera.ortho_height > 0; }},
    {Action::kMeasurement, "Path", hasScene, [](const Workspace& w) { return w.pin_measurement; }},
    {Action::kScreenshot, "Picture", hasScene, nullptr},
    {Action::kPalette, "Commands", [](const Workspace&) { return true; }, nullptr},
};

const Control& controlOf(Action action) {
    return *std::find_if(std::begin(kControls), std::end(kControls),
                         [&](const Control& each) { return each.action == action; });
}

std::string tipOf(Action action) {
    const Control& control = controlOf(action);
    std::string tip = std::string(control.does) + " (" + control.press + ")";
    std::erase(tip, '`');
    return tip;
}

void drawButton(Workspace& w, const ToolButton& button) {
    const bool on = button.is_on && button.is_on(w);
    ImGui::BeginDisabled(!button.is_enabled(w));
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    if (ImGui::Button(button.label)) w.requests.action = button.action;
    if (on) ImGui::PopStyleColor();
    ImGui::EndDisabled();
    tooltip(tipOf(button.action).c_str());
}

float widthOf(const ToolButton& button) {
    return ImGui::CalcTextSize(button.label).x + 2 * ImGui::GetStyle().FramePadding.x;
}

} // namespace

float drawToolbar(Workspace& w, FreeArea area) {
    constexpr float kMargin = 10; // design units, as for the statistics below
    const float margin = kMargin * uiScale(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
    float inside = 0;
    for (const ToolButton& button : kButtons) inside += widthOf(button) + gap;
    const float padding = 2 * ImGui::GetStyle().WindowPadding.x;
    const float width = std::min(inside - gap + padding, area.width - 2 * margin);
    if (width < widthOf(kButtons[0]) + padding) return 0;
    const float height =
        boxOnPicture("Toolbar", {ImVec2(margin, margin), ImVec2(0, 0)}, width, ImGuiWindowFlags_NoMove, [&] {
            float left = 0;
            for (const ToolButton& button : kButtons) {
                const bool fits = left > 0 && left + gap + widthOf(button) <= width - padding + 1;
                if (fits) ImGui::SameLine(0, gap);
                left = fits ? left + gap + widthOf(button) : widthOf(button);
                drawButton(w, button);
            }
        });
    return margin + height;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The list of all controls.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "runtime/window/input/controls.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units: columns for keys and descriptions.
constexpr float kPressWidth = 120, kDoesWidth = 250, kSheetMargin = 16;
/// The camera's controls are in the first of two columns.
constexpr const char* kFirstGroup = "Camera";

std::string plain(const char* text) {
    std::string shown = text;
    std::erase(shown, '`');
    return shown;
}

void drawRow(const Control& control) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", control.press);
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", plain(control.does).c_str());
    ImGui::PopStyleColor();
}

void drawGroupName(const char* group) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s", group);
}

/// Rows of the first group, or of all others.
void drawColumn(const char* id, bool first) {
    const ImGuiTableFlags fixed = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;
    if (!ImGui::BeginTable(id, 2, fixed)) return;
    ImGui::TableSetupColumn("press", ImGuiTableColumnFlags_WidthFixed, kPressWidth * uiScale());
    ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed, kDoesWidth * uiScale());
    std::string_view group;
    for (const Control& control : kControls) {
        if (*control.press == '\0' || (control.group == std::string_view(kFirstGroup)) != first) continue;
        if (group != control.group) drawGroupName(control.group);
        group = control.group;
        drawRow(control);
    }
    ImGui::EndTable();
}

} // namespace

void drawCheatSheet(Workspace& w, FreeArea area) {
    const float column = (kPressWidth + kDoesWidth + 2 * kSheetMargin) * uiScale();
    // if the area is too narrow, the list overlaps the panel
    if (area.width < column) area.width = ImGui::GetIO().DisplaySize.x;
    const bool wide = area.width > 2 * column;
    ImGui::SetNextWindowPos(ImVec2(area.width / 2, area.height / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(1, 1), ImVec2(area.width, area.height));
    const bool shown =
        ImGui::Begin("Controls", &w.show_cheat_sheet,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_HorizontalScrollbar);
    if (shown) {
        ImGui::BeginGroup();
        drawColumn("camera", true);
        ImGui::EndGroup();
        if (wide) ImGui::SameLine(0, kSheetMargin * uiScale());
        ImGui::BeginGroup();
        drawColumn("others", false);
        ImGui::EndGroup();
    }
    ImGui::End();
}

} // namespace pointrt

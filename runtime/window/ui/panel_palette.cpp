// SPDX-License-Identifier: Apache-2.0
// The command palette: the table of controls, searched by words.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/window/input/controls.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_input.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kPaletteWidth = 560, kKeysWidth = 150, kPaletteTop = 60;
constexpr float kMaxHeightShare = 0.6f;

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    std::erase(text, '`');
    return text;
}

/// The text typed into the palette.
std::string& query() {
    static std::string text;
    return text;
}

/// Commands that contain each typed word; without words, all.
std::vector<const Control*> foundControls(const std::string& typed) {
    std::vector<const Control*> found;
    for (const Control& control : kControls) {
        if (control.gesture != Gesture::kKey || *control.press == '\0' || control.action == Action::kPalette) continue;
        const std::string text = lowered(std::string(control.group) + " " + control.does + " " + control.press);
        std::istringstream words(lowered(typed));
        bool matches = true;
        for (std::string word; words >> word;) matches = matches && text.find(word) != std::string::npos;
        if (matches) found.push_back(&control);
    }
    return found;
}

void run(Workspace& w, const Control& control) {
    w.requests.action = control.action;
    w.show_palette = false;
}

void drawCommandRow(Workspace& w, const Control& control, bool chosen) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(&control);
    std::string does = control.does;
    std::erase(does, '`');
    if (ImGui::Selectable(does.c_str(), chosen, ImGuiSelectableFlags_SpanAllColumns)) run(w, control);
    if (chosen) ImGui::SetScrollHereY();
    ImGui::PopID();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", control.press);
}

/// The row chosen by the arrow keys.
int movedChoice(int count) {
    int chosen = storedInt("palette row", 0);
    if (ImGui::IsKeyPressed(uiKey(Key::kDown))) ++chosen;
    if (ImGui::IsKeyPressed(uiKey(Key::kUp))) --chosen;
    chosen = std::clamp(chosen, 0, std::max(0, count - 1));
    storedInt("palette row", 0) = chosen;
    return chosen;
}

void drawFound(Workspace& w, const std::vector<const Control*>& found, int chosen) {
    if (found.empty()) return dimText("No matching command.");
    if (!ImGui::BeginTable("commands", 2)) return;
    ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, kKeysWidth * uiScale());
    for (std::size_t n = 0; n < found.size(); ++n) drawCommandRow(w, *found[n], static_cast<int>(n) == chosen);
    ImGui::EndTable();
}

} // namespace

void drawPalette(Workspace& w, FreeArea area) {
    if (!w.show_palette) return query().clear();
    const float width = std::min(kPaletteWidth * uiScale(), area.width);
    const float top = std::min(kPaletteTop * uiScale(), area.height / 4);
    ImGui::SetNextWindowPos(ImVec2(area.width / 2, top), ImGuiCond_Always, ImVec2(0.5f, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 1), ImVec2(width, std::max(1.0f, kMaxHeightShare * area.height)));
    ImGui::SetNextWindowBgAlpha(1); // it lies over other text
    constexpr ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("Commands", nullptr, flags & ~ImGuiWindowFlags_NoScrollbar)) {
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(-1);
        const bool entered =
            ImGui::InputTextWithHint("##query", "search commands", &query(), ImGuiInputTextFlags_EnterReturnsTrue);
        const std::vector<const Control*> found = foundControls(query());
        const int chosen = movedChoice(static_cast<int>(found.size()));
        if (entered && !found.empty()) run(w, *found[static_cast<std::size_t>(chosen)]);
        drawFound(w, found, chosen);
        if (ImGui::IsKeyPressed(uiKey(Key::kEscape))) w.show_palette = false;
    }
    ImGui::End();
}

} // namespace pointrt

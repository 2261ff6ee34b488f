// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_ui.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/default_lighting.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kPanelWidth = 300;
/// Limit that keeps some of the picture in narrow windows.
constexpr float kMaxWindowShare = 0.6f;

struct Section {
    const char* name;
    void (*draw)(Workspace&);
    bool open;
};
constexpr Section kSections[] = {
    {"Layers", drawLayers, false},       {"Light", drawLights, true},    {"Sky", drawSky, false},
    {"Materials", drawMaterials, false}, {"Room", drawRoom, true},       {"Render", drawRender, false},
    {"Picture", drawPicture, true},      {"Colours", drawColors, false}, {"Camera", drawCamera, false},
    {"Views", drawViews, false},         {"Clip", drawClips, false},     {"Filter", drawFilters, false},
    {"Measure", drawMeasure, false},     {"Output", drawOutput, false},  {"About", drawAbout, false},
};

/// Scrolls down to the end of the section that was just drawn, but only so far that its header stays visible.
void showSection(float header_y) {
    const float below = ImGui::GetCursorScreenPos().y - ImGui::GetIO().DisplaySize.y;
    if (below > 0) ImGui::SetScrollY(ImGui::GetScrollY() + std::min(below, header_y));
}

float shownWidth() { return panelWidth(ImGui::GetIO().DisplaySize.x, uiScale()); }

void drawPanel(Workspace& w) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(window.x - shownWidth(), 0));
    ImGui::SetNextWindowSize(ImVec2(shownWidth(), window.y));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    const bool shown = ImGui::Begin("Panel", nullptr,
                                    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    ImGui::PopStyleVar();
    for (const Section& section : kSections) {
        if (!shown) break;
        const float header_y = ImGui::GetCursorScreenPos().y;
        bool& open = w.open_sections.try_emplace(section.name, section.open).first->second;
        ImGui::SetNextItemOpen(open, ImGuiCond_Once);
        open = ImGui::CollapsingHeader(section.name);
        if (!open) continue;
        const bool was_closed = ImGui::IsItemToggledOpen();
        ImGui::PushID(section.name);
        section.draw(w);
        ImGui::PopID();
        ImGui::Dummy(ImVec2(0, 4 * uiScale()));
        if (was_closed) showSection(header_y);
    }
    ImGui::End();
}

} // namespace

float panelWidth(float window_width, float scale) {
    return std::min(kPanelWidth * scale, kMaxWindowShare * window_width);
}

double sceneSize(const Workspace& w) {
    const double size = length(w.scene_max - w.scene_min);
    constexpr double smallest = 1e-9, largest = 1e13; // limits of scene files
    return size > smallest && size < largest ? size : 1;
}

Vec3 sceneUpright(const Workspace& w) {
    const Vec3 up = sceneUp(w.scene, w.settings);
    const double size = length(up);
    return size > 0 && std::isfinite(size) ? up * (1 / size) : Vec3{0, 1, 0};
}

void drawUi(Workspace& w) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const bool has_panel = w.show_panel && hasScene(w); // without a scene there is nothing to edit
    const FreeArea area{std::max(1.0f, window.x - (has_panel ? shownWidth() : 0)), std::max(1.0f, window.y)};
    drawPickMarks(w);
    const float below = w.show_panel ? drawToolbar(w, area) : 0; // without the panel, only the picture is shown
    if (w.show_hud) drawHud(w, area, below);
    drawLegendBox(w, area);
    drawEmptyState(w, area);
    drawWayBack(w, area);
    if (has_panel) drawPanel(w);
    drawGizmo(w);
    drawJobAndNotices(w, area);
    if (w.show_cheat_sheet) drawCheatSheet(w, area);
    drawBrowser(w, area);
    drawPalette(w, area);
    drawQuestion(w);
    w.requests.typing = ImGui::GetIO().WantTextInput;
    endEdits(w.requests);
}

} // namespace pointrt

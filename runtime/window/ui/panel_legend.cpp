// SPDX-License-Identifier: Apache-2.0
// The legend of the scans' colours.
#include <imgui.h>

#include <algorithm>

#include "runtime/window/ui/panel_box.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kLegendMargin = 10, kBarWidth = 18, kLegendBarHeight = 170, kTickWidth = 5, kSwatch = 11,
                kLegendWidth = 200;
constexpr ImU32 kTickColor = IM_COL32(255, 255, 255, 200);

ImU32 packed(Srgb8 color) { return IM_COL32(color[0], color[1], color[2], 255); }

/// Drawn as one rectangle per colour, less than a pixel high.
void drawBar(ImDrawList& list, ImVec2 corner, const Legend& legend) {
    const float scale = uiScale(), piece = kLegendBarHeight * scale / static_cast<float>(legend.bar.size());
    for (std::size_t i = 0; i < legend.bar.size(); ++i) {
        const float top = corner.y + kLegendBarHeight * scale - static_cast<float>(i + 1) * piece;
        list.AddRectFilled(ImVec2(corner.x, top), ImVec2(corner.x + kBarWidth * scale, top + piece + 1),
                           packed(legend.bar[i]));
    }
    for (const LegendTick& tick : legend.ticks) {
        const float y = corner.y + static_cast<float>(1 - tick.share) * kLegendBarHeight * scale;
        const float x = corner.x + kBarWidth * scale;
        list.AddLine(ImVec2(x, y), ImVec2(x + kTickWidth * scale, y), kTickColor, scale);
        list.AddText(ImVec2(x + 2 * kTickWidth * scale, y - ImGui::GetTextLineHeight() / 2),
                     ImGui::GetColorU32(ImGuiCol_Text), tick.text.c_str());
    }
}

void drawEntry(ImDrawList& list, const LegendEntry& entry) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float size = kSwatch * uiScale(), top = corner.y + (ImGui::GetTextLineHeight() - size) / 2;
    list.AddRectFilled(ImVec2(corner.x, top), ImVec2(corner.x + size, top + size), packed(entry.color));
    ImGui::Dummy(ImVec2(size, size));
    ImGui::SameLine();
    ImGui::TextUnformatted(entry.text.c_str());
}

void drawContent(const Legend& legend) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::TextUnformatted(legend.title.c_str());
    for (const LegendEntry& entry : legend.entries) drawEntry(list, entry);
    if (legend.bar.empty()) return;
    const float half_line = ImGui::GetTextLineHeight() / 2;
    ImGui::Dummy(ImVec2(1, half_line));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    drawBar(list, corner, legend);
    ImGui::Dummy(ImVec2(1, kLegendBarHeight * uiScale() + half_line));
}

} // namespace

void drawLegendBox(const Workspace& w, FreeArea area) {
    const bool shown = w.settings.color_by != kOwnColors && w.settings.legend.value_or(true);
    const float margin = kLegendMargin * uiScale(), width = kLegendWidth * uiScale();
    if (!w.legend || !shown || area.width < width + 2 * margin) return;
    constexpr ImGuiWindowFlags through = ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::SetNextWindowBgAlpha(0.6f);
    boxOnPicture("Legend", {ImVec2(margin, area.height - margin), ImVec2(0, 1)}, width, through,
                 [&] { drawContent(*w.legend); });
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Markers on the picture at picked points, and measurements.
#include <imgui.h>

#include <cmath>

#include "runtime/window/ui/on_screen.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Light lines on dark ones are visible on any picture.
constexpr ImU32 kLight = IM_COL32(255, 255, 255, 235), kDark = IM_COL32(0, 0, 0, 150);
constexpr ImU32 kLine = IM_COL32(125, 190, 235, 235);

void drawCross(ImDrawList& list, ImVec2 at) {
    const float inner = 3 * uiScale(), outer = 9 * uiScale();
    for (const auto& [color, width] : {std::pair{kDark, 3.5f}, {kLight, 1.5f}})
        for (const auto& [x, y] : {std::pair{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}})
            list.AddLine(ImVec2(at.x + inner * x, at.y + inner * y), ImVec2(at.x + outer * x, at.y + outer * y), color,
                         width * uiScale());
}

void drawLabel(ImDrawList& list, ImVec2 middle, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 4 * uiScale();
    const ImVec2 corner(middle.x - size.x / 2, middle.y - size.y / 2);
    list.AddRectFilled(ImVec2(corner.x - pad, corner.y - pad / 2),
                       ImVec2(corner.x + size.x + pad, corner.y + size.y + pad / 2), IM_COL32(20, 20, 20, 215), pad);
    list.AddText(corner, kLight, text.c_str());
}

/// Returns whether both ends are in front of the eye.
bool drawLeg(const Workspace& w, ImDrawList& list, Vec3 a, Vec3 b) {
    const auto from = onScreen(w, a), to = onScreen(w, b);
    if (!from || !to) return false;
    list.AddLine(*from, *to, kDark, 3.5f * uiScale());
    list.AddLine(*from, *to, kLine, 1.5f * uiScale());
    return true;
}

void drawDistance(const Workspace& w, ImDrawList& list, const PickedPoint& a, const PickedPoint& b) {
    if (!drawLeg(w, list, a.position, b.position)) return;
    const auto from = onScreen(w, a.position), to = onScreen(w, b.position);
    drawLabel(list, ImVec2((from->x + to->x) / 2, (from->y + to->y) / 2),
              shownLength(w, length(b.position - a.position), measuredSize(sceneSize(w))));
}

void drawKeptMeasure(const Workspace& w, ImDrawList& list, const MeasureDescription& measure) {
    const std::vector<Vec3>& points = measure.points;
    for (std::size_t p = 1; p < points.size(); ++p) drawLeg(w, list, points[p - 1], points[p]);
    if (measure.closed) drawLeg(w, list, points.back(), points.front());
    for (const Vec3 point : points)
        if (const auto at = onScreen(w, point)) list.AddCircleFilled(*at, 2.5f * uiScale(), kLight);
    if (const auto at = onScreen(w, labelPlace(measure))) drawLabel(list, *at, labelOf(measure, w.measure_units));
}

} // namespace

void drawPickMarks(const Workspace& w) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const MeasureDescription& each : w.scene.measures)
        if (each.visible) drawKeptMeasure(w, list, each);
    for (std::size_t p = 1; p < w.picks.size(); ++p) drawDistance(w, list, w.picks[p - 1], w.picks[p]);
    for (std::size_t p = 0; p < w.picks.size(); ++p)
        if (const auto at = onScreen(w, w.picks[p].position)) drawCross(list, *at);
}

} // namespace pointrt

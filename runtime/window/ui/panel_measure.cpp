// SPDX-License-Identifier: Apache-2.0
// The Measure section: picked points and distances.
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

/// Three decimals: 1/16 of a degree.
std::string normalText(Vec3 normal) {
    constexpr double unit_with_three_decimals = 10;
    return pointText(normal, unit_with_three_decimals);
}

std::string sourceText(const PickedPoint& pick) {
    const std::string source = std::filesystem::path(pick.source).filename().string();
    const bool of_file = pick.radius > 0;
    return of_file ? source + ", splat " + std::to_string(pick.splat) : source;
}

std::string colorText(const PickedPoint& pick) {
    if (!pick.color) return "none";
    const auto& [red, green, blue] = *pick.color;
    return std::to_string(red) + "  " + std::to_string(green) + "  " + std::to_string(blue);
}

void colorRowOf(const PickedPoint& pick) {
    pushRow("Colour", "");
    if (pick.color) {
        const float side = ImGui::GetFontSize();
        const ImColor swatch((*pick.color)[0], (*pick.color)[1], (*pick.color)[2]);
        ImGui::ColorButton("##swatch", swatch, ImGuiColorEditFlags_NoTooltip, ImVec2(side, side));
        ImGui::SameLine();
    }
    ImGui::TextUnformatted(colorText(pick).c_str());
    popRow();
}

void drawPick(const Workspace& w, const PickedPoint& pick) {
    const double size = measuredSize(sceneSize(w));
    valueRow("Source", sourceText(pick).c_str());
    valueRow("Position", pointText(pick.position, size).c_str());
    valueRow("Normal", normalText(pick.normal).c_str());
    colorRowOf(pick);
    if (!pick.value.empty()) valueRow("Coloured by", pick.value.c_str());
    if (pick.radius > 0) valueRow("Radius", lengthText(pick.radius, size).c_str());
    valueRow("Distance", (lengthText(pick.distance, size) + " from the eye").c_str());
}

std::string pickLine(const PickedPoint& pick, double size) {
    return sourceText(pick) + "\tposition " + pointText(pick.position, size) + "\tnormal " + normalText(pick.normal) +
           "\tcolour " + colorText(pick) + (pick.value.empty() ? "" : "\t" + pick.value) + "\n";
}

/// Distance between the last two picks, which must exist.
std::string distanceText(const Workspace& w) {
    const double apart = length(w.picks.back().position - w.picks[w.picks.size() - 2].position);
    return lengthText(apart, measuredSize(sceneSize(w)));
}

/// The picks as text, one per line.
std::string measureText(const Workspace& w) {
    std::string text;
    for (const PickedPoint& pick : w.picks) text += pickLine(pick, measuredSize(sceneSize(w)));
    if (w.picks.size() < 2) return text;
    return text + "length " + distanceText(w) + "\n";
}

} // namespace

void drawLastPick(const Workspace& w) {
    drawPick(w, w.picks.back());
    if (w.picks.size() < 2) return;
    valueRow("Length", distanceText(w).c_str());
}

void drawMeasure(Workspace& w) {
    if (w.picks.empty()) return dimText("Click a point in the picture.");
    const PickedPoint& last = w.picks.back();
    ImGui::TextDisabled("Last pick");
    drawPick(w, last);
    if (w.picks.size() > 1) {
        const PickedPoint& before = w.picks[w.picks.size() - 2];
        ImGui::TextDisabled("Previous pick");
        drawPick(w, before);
        ImGui::Separator();
        valueRow("Length", distanceText(w).c_str());
        checkboxRow("Keep line", w.pin_measurement, "M: keep the line on the picture");
    }
    if (columnButton("Copy as text", 1)) ImGui::SetClipboardText(measureText(w).c_str());
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Measure section: picked points and distances.
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/layers.h"
#include "runtime/util/vec_array.h"
#include "runtime/window/edit/picked_path.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

/// Three decimals resolve 1/16 of a degree.
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
    valueRow("Position", shownPoint(w, pick.position, size).c_str());
    valueRow("Normal", normalText(pick.normal).c_str());
    colorRowOf(pick);
    if (!pick.value.empty()) valueRow("Coloured by", pick.value.c_str());
    if (pick.radius > 0) valueRow("Radius", shownLength(w, pick.radius, size).c_str());
    valueRow("Distance", (shownLength(w, pick.distance, size) + " from the eye").c_str());
}

std::string pickLine(const PickedPoint& pick, double size) {
    return sourceText(pick) + "\tposition " + pointText(pick.position, size) + "\tnormal " + normalText(pick.normal) +
           "\tcolour " + colorText(pick) + (pick.value.empty() ? "" : "\t" + pick.value) + "\n";
}

/// Measures of the picked points, of which there are at least two.
PathMeasures measuresOf(const Workspace& w) { return pickedPath(w.picks, sceneUpright(w)).measures; }

std::string distanceText(const Workspace& w) {
    return shownLength(w, measuresOf(w).last_leg, measuredSize(sceneSize(w)));
}

using MeasureRow = std::pair<const char*, std::string>;
std::vector<MeasureRow> measureRows(const Workspace& w) {
    const double size = measuredSize(sceneSize(w));
    const PathMeasures measures = measuresOf(w);
    std::vector<MeasureRow> rows = {{"Length", shownLength(w, measures.last_leg, size)},
                                    {"Horizontal", shownLength(w, measures.horizontal, size)},
                                    {"Height", shownLength(w, measures.height, size)},
                                    {"dx dy dz", shownPoint(w, vectorOf(measures.difference), size)}};
    if (!measures.angle_deg) return rows;
    constexpr double unit_with_three_decimals = 10;
    rows.emplace_back("Path", shownLength(w, measures.length, size));
    rows.emplace_back("Angle", lengthText(*measures.angle_deg, unit_with_three_decimals) + " degrees");
    rows.emplace_back("Area", shownArea(w, *measures.area, size));
    rows.emplace_back("In plan", shownArea(w, *measures.plan_area, size));
    return rows;
}

/// The picks as text, one per line.
std::string measureText(const Workspace& w) {
    std::string text;
    for (const PickedPoint& pick : w.picks) text += pickLine(pick, measuredSize(sceneSize(w)));
    if (w.picks.size() < 2) return text;
    for (const auto& [name, value] : measureRows(w)) text += std::string(name) + "\t" + value + "\n";
    return text;
}

/// The measurements of the scene.
void drawKept(const Workspace& w) {
    if (w.scene.measures.empty()) return;
    ImGui::TextDisabled("Kept");
    for (std::size_t n = 0; n < w.scene.measures.size(); ++n)
        valueRow(layerName(w.scene, {LayerKind::kMeasure, n}).c_str(),
                 measuredText(w.scene.measures[n], w.measure_units).c_str());
    ImGui::Separator();
}

void drawPicks(const Workspace& w) {
    ImGui::TextDisabled("Last pick");
    drawPick(w, w.picks.back());
    if (w.picks.size() < 2) return;
    ImGui::TextDisabled("Previous pick");
    drawPick(w, w.picks[w.picks.size() - 2]);
    ImGui::Separator();
    for (const auto& [name, value] : measureRows(w)) valueRow(name, value.c_str());
}

} // namespace

void drawLastPick(const Workspace& w) {
    drawPick(w, w.picks.back());
    if (w.picks.size() < 2) return;
    valueRow("Length", distanceText(w).c_str());
}

void drawMeasure(Workspace& w) {
    drawKept(w);
    if (w.picks.empty()) return dimText("Click a point in the picture, then another one.");
    drawPicks(w);
    checkboxRow("Path", w.pin_measurement, "M: each click adds a point to a path, for angles and areas");
    ImGui::BeginDisabled(w.picks.size() < 2);
    if (columnButton("Keep measurement", 1, false, "K: keep it with the scene; it is listed under Layers"))
        w.requests.keep_measurement = true;
    if (columnButton("Save measurement", 1, false, "CSV, GeoJSON and DXF, in the scan's coordinates"))
        w.requests.save_measurement = true;
    ImGui::EndDisabled();
    if (columnButton("Copy as text", 1)) ImGui::SetClipboardText(measureText(w).c_str());
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Layers section: every part of the scene, to show, name, lock and delete.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "runtime/scene/layers.h"
#include "runtime/window/edit/placement_edit.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

struct KindRow {
    LayerKind kind;
    const char* heading;
    const char* selection; ///< stored number that the kind's own section selects by; null: it has none
};
constexpr KindRow kKindRows[] = {{LayerKind::kScan, "Scans", nullptr},
                                 {LayerKind::kShape, "Shapes", nullptr},
                                 {LayerKind::kLight, "Lights", "selected light"},
                                 {LayerKind::kClip, "Clips", "selected clip"},
                                 {LayerKind::kMeasure, "Measurements", nullptr}};

/// Measurements are drawn over the picture, which does not change with them.
bool reportLayerEdit(Workspace& w, LayerId id, bool changed) {
    return id.kind == LayerKind::kMeasure ? changed : reportSceneEdit(w, changed);
}

/// Stored number: the last frame in which the placement of a scan was shown.
constexpr const char* kPlacedFrame = "placement shown";

LayerId selectedLayer() {
    const auto kind = static_cast<LayerKind>(storedInt("selected layer kind", 0));
    return {kind, static_cast<std::size_t>(storedInt("selected layer", 0))};
}

void select(LayerId id, const KindRow& row) {
    storedInt("selected layer kind", 0) = static_cast<int>(id.kind);
    storedInt("selected layer", 0) = static_cast<int>(id.number);
    if (row.selection) storedInt(row.selection, 0) = static_cast<int>(id.number);
}

void drawLayerRow(Workspace& w, LayerId id, const KindRow& row) {
    ImGui::PushID(static_cast<int>(id.number));
    bool visible = isLayerVisible(w.scene, id);
    if (reportLayerEdit(w, id, ImGui::Checkbox("##visible", &visible))) setLayerVisible(w.scene, id, visible);
    tooltip(id.kind == LayerKind::kClip ? "whether it cuts" : "show or hide");
    ImGui::SameLine();
    const std::string name = layerName(w.scene, id) + (layerAt(w.scene, id).locked ? "  (locked)" : "");
    if (ImGui::Selectable((name + "##name").c_str(), id == selectedLayer())) select(id, row);
    ImGui::PopID();
}

void drawKind(Workspace& w, const KindRow& row, const std::vector<LayerId>& layers) {
    const auto is_row = [&](LayerId id) { return id.kind == row.kind; };
    const auto count = static_cast<int>(std::count_if(layers.begin(), layers.end(), is_row));
    if (count == 0) return;
    if (!ImGui::TreeNodeEx(row.heading, ImGuiTreeNodeFlags_DefaultOpen, "%s (%d)", row.heading, count)) return;
    for (const LayerId id : layers)
        if (is_row(id)) drawLayerRow(w, id, row);
    ImGui::TreePop();
}

void drawMeasurement(Workspace& w) {
    if (w.picks.empty()) return;
    ImGui::AlignTextToFramePadding();
    ImGui::Text("Picks (%d)", static_cast<int>(w.picks.size()));
    ImGui::SameLine();
    if (ImGui::SmallButton("Clear")) w.picks.clear();
}

void drawMeasureValues(const Workspace& w, MeasureDescription& measure) {
    valueRow(measure.closed ? "Area" : "Length", measuredText(measure, w.measure_units).c_str());
    ImGui::BeginDisabled(measure.layer.locked || measure.points.size() < 3);
    checkboxRow("Closed", measure.closed, "measure the area that the path encloses; it needs three points");
    ImGui::EndDisabled();
}

/// Where a scan lies: its translation, turns about the axes of the world through its middle, and its scale.
void drawPlacement(Workspace& w, InstanceDescription& scan, Vec3 centre) {
    Placement& placement = scan.placement;
    reportSceneEdit(w, pointRow("Moved by", placement.translation, sceneSize(w), w.measure_units.unit,
                                "added to the scan's coordinates; drag, or Ctrl + click to type"));
    constexpr double kDegreesAUnit = 0.25; // a quarter turn for a drag across the panel
    const struct {
        const char* name;
        Vec3 axis;
    } turns[] = {{"Turn about X", {1, 0, 0}}, {"Turn about Y", {0, 1, 0}}, {"Turn about Z", {0, 0, 1}}};
    for (const auto& turn : turns) {
        double degrees = 0; // each drag turns further
        const bool changed = dragRow(turn.name, degrees, {-180, 180}, kDegreesAUnit, "%.2f\u00b0",
                                     "about the scan's middle; drag, or Ctrl + click to type degrees");
        if (reportSceneEdit(w, changed)) placement = turned(placement, centre, turn.axis, degrees);
    }
    double scale = placement.scale;
    if (reportSceneEdit(w, dragRow("Scale", scale, {1e-6, 1e6}, 0.005 * scale, "%.6g", "about the scan's middle")))
        placement = scaledTo(placement, centre, scale);
}

/// Neither name nor lock change the picture, so they request no update.
void drawSelected(Workspace& w, LayerId id) {
    Layer& layer = layerAt(w.scene, id);
    textRow("Name", layer.name, layerName(w.scene, id).c_str(), "in lists, and for --hide");
    std::erase_if(layer.name, [](unsigned char c) { return std::iscntrl(c) != 0; });
    if (id.kind == LayerKind::kMeasure) drawMeasureValues(w, w.scene.measures[id.number]);
    if (id.kind == LayerKind::kScan && id.number < w.scan_centres.size()) {
        ImGui::BeginDisabled(layer.locked);
        drawPlacement(w, w.scene.instances[id.number], w.scan_centres[id.number]);
        storedInt(kPlacedFrame, 0) = ImGui::GetFrameCount();
        ImGui::EndDisabled();
    }
    checkboxRow("Locked", layer.locked, "keeps it from being edited or deleted");
    ImGui::BeginDisabled(!mayDelete(w.scene, id));
    if (reportLayerEdit(w, id, columnButton("Delete", 1, false, "Ctrl + Z brings it back"))) deleteLayer(w.scene, id);
    ImGui::EndDisabled();
}

} // namespace

std::optional<std::size_t> placedLayer() {
    if (storedInt(kPlacedFrame, -1) != ImGui::GetFrameCount()) return std::nullopt;
    return selectedLayer().number;
}

void drawLayers(Workspace& w) {
    const std::vector<LayerId> layers = layersOf(w.scene);
    if (layers.empty()) return dimText("No scene is open.");
    for (const KindRow& row : kKindRows) drawKind(w, row, layers);
    drawMeasurement(w);
    const LayerId selected = selectedLayer();
    if (std::find(layers.begin(), layers.end(), selected) == layers.end()) return;
    ImGui::Separator();
    drawSelected(w, selected);
}

} // namespace pointrt

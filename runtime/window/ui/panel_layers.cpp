// SPDX-License-Identifier: Apache-2.0
// The Layers section: every part of the scene, to show, name, lock and delete.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "runtime/scene/layers.h"
#include "runtime/window/edit/compare_job.h"
#include "runtime/window/edit/placement_edit.h"
#include "runtime/window/edit/shape_edit.h"
#include "runtime/window/ui/layer_selection.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

struct KindRow {
    LayerKind kind;
    const char* heading;
};
constexpr KindRow kKindRows[] = {{LayerKind::kScan, "Scans"},
                                 {LayerKind::kShape, "Shapes"},
                                 {LayerKind::kLight, "Lights"},
                                 {LayerKind::kClip, "Clips"},
                                 {LayerKind::kMeasure, "Measurements"}};

struct ShapeWords {
    ShapeKind kind;
    const char* label;
    const char* hint;
};
constexpr ShapeWords kShapeWords[] = {{ShapeKind::kSphere, "Ball", "a mirror, glass or gold by its material"},
                                      {ShapeKind::kBox, "Box", "a block, a plinth"},
                                      {ShapeKind::kQuad, "Pane", "an upright rectangle: a mirror, a window"},
                                      {ShapeKind::kDisc, "Disc", "upright"}};
static_assert(std::size(kShapeWords) == std::size(kInsertedShapes));

/// Measurements are drawn over the picture, which does not change with them.
bool reportLayerEdit(Workspace& w, LayerId id, bool changed) {
    return id.kind == LayerKind::kMeasure ? changed : reportSceneEdit(w, changed);
}

void drawLayerRow(Workspace& w, LayerId id) {
    ImGui::PushID(static_cast<int>(id.number));
    bool visible = isLayerVisible(w.scene, id);
    if (reportLayerEdit(w, id, ImGui::Checkbox("##visible", &visible))) setLayerVisible(w.scene, id, visible);
    tooltip(id.kind == LayerKind::kClip ? "turn this clip on or off" : "show or hide");
    ImGui::SameLine();
    const std::string name = layerName(w.scene, id) + (layerAt(w.scene, id).locked ? "  (locked)" : "");
    if (ImGui::Selectable((name + "##name").c_str(), id == selectedLayer())) selectLayer(id);
    ImGui::PopID();
}

void drawKind(Workspace& w, const KindRow& row, const std::vector<LayerId>& layers) {
    const auto is_row = [&](LayerId id) { return id.kind == row.kind; };
    const auto count = static_cast<int>(std::count_if(layers.begin(), layers.end(), is_row));
    if (count == 0) return;
    if (!ImGui::TreeNodeEx(row.heading, ImGuiTreeNodeFlags_DefaultOpen, "%s (%d)", row.heading, count)) return;
    for (const LayerId id : layers)
        if (is_row(id)) drawLayerRow(w, id);
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

/// The place of a scan: its translation, rotations about the world axes through its middle, and its scale.
void drawPlacement(Workspace& w, InstanceDescription& scan, Vec3 centre) {
    Placement& placement = scan.placement;
    reportSceneEdit(w, pointRow("Moved by", placement.translation, sceneSize(w), w.measure_units.unit,
                                "added to the scan's coordinates; drag, or Ctrl + click to type"));
    constexpr double kDegreesAUnit = 0.25; // a drag across the panel is a quarter turn
    const struct {
        const char* name;
        Vec3 axis;
    } turns[] = {{"Turn about X", {1, 0, 0}}, {"Turn about Y", {0, 1, 0}}, {"Turn about Z", {0, 0, 1}}};
    for (const auto& turn : turns) {
        double degrees = 0; // each drag rotates on from there
        const bool changed = dragRow(turn.name, degrees, {-180, 180}, kDegreesAUnit, "%.2f\u00b0",
                                     "about the scan's middle; drag, or Ctrl + click to type degrees");
        if (reportSceneEdit(w, changed)) placement = turned(placement, centre, turn.axis, degrees);
    }
    double scale = placement.scale;
    if (reportSceneEdit(w, dragRow("Scale", scale, {1e-6, 1e6}, 0.005 * scale, "%.6g", "about the scan's middle")))
        placement = scaledTo(placement, centre, scale);
}

/// Offers to bake the scans again with another kind of splats, since the lists of cells depend on the kind.
void drawSplatKind(Workspace& w) {
    if (!w.may_bake_again) return;
    constexpr struct {
        const char* label;
        const char* option;
    } kKinds[] = {{"discs, and balls where there is no surface", "auto"}, {"discs", "disc"}, {"balls", "ball"}};
    pushRow("Bake again", "bakes the scan with another kind of splats, and opens it");
    if (ImGui::BeginCombo("##value", "choose")) {
        for (const auto& kind : kKinds)
            if (ImGui::Selectable(kind.label)) w.requests.bake_again = kind.option;
        ImGui::EndCombo();
    }
    popRow();
}

/// Offers to measure a scan's distances from another one's surface.
void drawComparison(Workspace& w, std::size_t scan) {
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < w.scene.instances.size(); ++i)
        if (i != scan && !w.scene.instances[i].deleted) others.push_back(i);
    if (others.empty() || !mayCompare(w.scene.instances[scan])) return;
    pushRow("Compare with", "colours this scan by its distances from the surface of another, as pointrt-rays compare");
    if (ImGui::BeginCombo("##value", "choose")) {
        for (const std::size_t other : others) {
            const std::string name = layerName(w.scene, {LayerKind::kScan, other}) + "##" + std::to_string(other);
            if (ImGui::Selectable(name.c_str())) w.requests.compare = Comparison{other, scan};
        }
        ImGui::EndCombo();
    }
    popRow();
}

/// Sizes along the axes of a shape, or its diameter.
void drawShapeSize(Workspace& w, ShapeDescription& shape) {
    const auto row = [&](const char* name, double size, std::initializer_list<Vec3*> edges) {
        const SliderRange range{1e-6 * sceneSize(w), 100 * sceneSize(w)};
        const double before = size;
        if (!reportSceneEdit(w, dragRow(name, size, range, 0.005 * size, "%.6g", "Ctrl + click to type"))) return;
        for (Vec3* edge : edges) *edge = (size / before) * *edge;
    };
    const double across = 2 * length(shape.u), along = 2 * length(shape.v);
    switch (shape.kind) {
    case ShapeKind::kSphere:
        return row("Diameter", across, {&shape.u, &shape.v, &shape.w});
    case ShapeKind::kDisc:
        return row("Diameter", across, {&shape.u, &shape.v});
    case ShapeKind::kBox:
        row("Width", across, {&shape.u});
        row("Depth", along, {&shape.v});
        return row("Height", 2 * length(shape.w), {&shape.w});
    case ShapeKind::kQuad:
        row("Width", across, {&shape.u});
        return row("Height", along, {&shape.v});
    case ShapeKind::kPlane:
        return;
    }
}

Vec3 towardsEye(const Workspace& w, Vec3 normal, Vec3 point) {
    return dot(w.camera.eye - point, normal) < 0 ? -1.0 * normal : normal;
}

void drawShape(Workspace& w, ShapeDescription& shape) {
    ImGui::BeginDisabled(shape.layer.locked);
    drawShapeSize(w, shape);
    drawShapeMaterial(w, shape.material);
    ImGui::BeginDisabled(w.picks.empty());
    if (reportSceneEdit(w, columnButton("Rest on the picked point", 1, false, "click a surface in the picture first")))
        restOn(shape, w.picks.back().position, towardsEye(w, w.picks.back().normal, w.picks.back().position));
    ImGui::EndDisabled();
    ImGui::EndDisabled();
}

/// The place for a new shape: at the last picked point; else in front of the scan, at the height of its lowest point,
/// since places beside the scan may be outside the picture.
ShapePlace placeOfNewShape(const Workspace& w) {
    const ViewAxes axes = axesOf(w.camera);
    const Vec3 up = sceneUpright(w);
    // the shape then faces the lower edge of the picture
    const bool from_above = std::abs(dot(axes.forward, up)) > 0.99;
    const Vec3 towards_eye = from_above ? -1.0 * axes.up : -1.0 * axes.forward;
    constexpr double kShareOfScene = 0.2;
    const double size = kShareOfScene * sceneSize(w);
    if (!w.picks.empty()) {
        const PickedPoint& pick = w.picks.back();
        return {pick.position, towardsEye(w, pick.normal, pick.position), up, towards_eye, size};
    }
    const Vec3 middle = 0.5 * (w.scene_min + w.scene_max), half = 0.5 * (w.scene_max - w.scene_min);
    const double below = dot(absolute(up), half);
    const Vec3 level = normalize(towards_eye - dot(towards_eye, up) * up);
    const double ahead = dot(absolute(level), half) + 0.6 * size;
    return {middle - below * up + ahead * level, up, up, towards_eye, size};
}

/// "Ball", or "Ball 2" if there is one.
std::string freeLayerName(const SceneDescription& scene, const std::string& kind) {
    std::string name = kind;
    for (int number = 2; layerNamed(scene, name); ++number) name = kind + " " + std::to_string(number);
    return name;
}

void drawAddShape(Workspace& w) {
    ImGui::BeginDisabled(!mayAddShape(w.scene));
    if (columnButton("Add a shape", 1, false, "at the last picked point, or in front of the scan"))
        ImGui::OpenPopup("add shape");
    ImGui::EndDisabled();
    if (!ImGui::BeginPopup("add shape")) return;
    for (const ShapeWords& each : kShapeWords)
        if (reportSceneEdit(w, ImGui::MenuItem(each.label, each.hint))) {
            addShape(w.scene, each.kind, placeOfNewShape(w));
            w.scene.shapes.back().layer.name = freeLayerName(w.scene, each.label);
            selectLayer({LayerKind::kShape, w.scene.shapes.size() - 1});
        }
    ImGui::EndPopup();
}

/// Name and lock do not change the picture, so they request no update.
void drawSelected(Workspace& w, LayerId id) {
    Layer& layer = layerAt(w.scene, id);
    textRow("Name", layer.name, layerName(w.scene, id).c_str(), "in lists, and for --hide");
    std::erase_if(layer.name, [](unsigned char c) { return std::iscntrl(c) != 0; });
    if (id.kind == LayerKind::kMeasure) drawMeasureValues(w, w.scene.measures[id.number]);
    if (id.kind == LayerKind::kShape) drawShape(w, w.scene.shapes[id.number]);
    offerHandles(id);
    if (id.kind == LayerKind::kScan && id.number < w.scan_centres.size()) {
        ImGui::BeginDisabled(layer.locked);
        drawPlacement(w, w.scene.instances[id.number], w.scan_centres[id.number]);
        if (w.settings.color_by != kOwnColors)
            reportSceneEdit(
                w, checkboxRow("Coloured", w.scene.instances[id.number].colored,
                               "off: this scan keeps its own colours when the Colours section colours the others"));
        drawComparison(w, id.number);
        drawSplatKind(w);
        ImGui::EndDisabled();
    }
    checkboxRow("Locked", layer.locked, "keeps it from being edited or deleted");
    ImGui::BeginDisabled(!mayDelete(w.scene, id));
    if (reportLayerEdit(w, id, columnButton("Delete", 1, false, "Ctrl + Z brings it back"))) deleteLayer(w.scene, id);
    ImGui::EndDisabled();
}

} // namespace

void drawLayers(Workspace& w) {
    const std::vector<LayerId> layers = layersOf(w.scene);
    if (layers.empty()) return dimText("No scene is open.");
    for (const KindRow& row : kKindRows) drawKind(w, row, layers);
    drawAddShape(w);
    drawMeasurement(w);
    const LayerId selected = selectedLayer();
    if (std::find(layers.begin(), layers.end(), selected) == layers.end()) return;
    ImGui::Separator();
    drawSelected(w, selected);
}

} // namespace pointrt

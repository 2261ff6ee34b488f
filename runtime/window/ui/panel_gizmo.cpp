// SPDX-License-Identifier: Apache-2.0
// Handles over the picture: arrows that move the selected layer along the axes, and arcs that rotate it about them.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "runtime/scene/layers.h"
#include "runtime/util/degree.h"
#include "runtime/window/edit/layer_transform.h"
#include "runtime/window/ui/layer_selection.h"
#include "runtime/window/ui/on_screen.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

struct GizmoAxis {
    const char* move_id;
    const char* turn_id;
    Vec3 direction;
    ImU32 color; ///< red, green and blue for x, y and z, as everywhere
};
constexpr std::array<GizmoAxis, 3> kAxes{{{"##move x", "##turn x", {1, 0, 0}, IM_COL32(235, 80, 80, 255)},
                                          {"##move y", "##turn y", {0, 1, 0}, IM_COL32(90, 200, 90, 255)},
                                          {"##move z", "##turn z", {0, 0, 1}, IM_COL32(90, 140, 245, 255)}}};
/// Length of the arrows as a share of the picture's height.
constexpr double kArrowShare = 0.12;
/// Radius of the arcs relative to the arrows: they cross between the arrows without touching their handles.
constexpr double kArcRadius = 0.75;
/// Chords of an arc of a quarter turn: enough to look round at any size on a screen.
constexpr int kArcChords = 16;
/// Radius of a handle in window units: the handle is as wide as a finger.
constexpr float kHandleRadius = 9;
/// Smallest length of an arrow in window units: an axis seen nearly end-on cannot be dragged along.
constexpr float kShortestArrow = 12;

float lengthOf(ImVec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Length of the arrows in scene units, at a point.
double arrowLength(const Workspace& w, Vec3 at) {
    const double depth = dot(at - w.camera.eye, axesOf(w.camera).forward);
    const double height =
        w.camera.ortho_height > 0 ? w.camera.ortho_height : heightAtPivot(w.camera) * depth / distanceToPivot(w.camera);
    return kArrowShare * height;
}

/// How far a handle was dragged in this frame, in window units, and whether the mouse holds it.
struct HandleDrag {
    ImVec2 by;
    bool held;
};
/// Draws a handle that captures the mouse. Reports a drag as an edit of the scene.
HandleDrag dragHandle(Workspace& w, const char* id, ImVec2 at, float radius) {
    ImGui::SetNextWindowPos(ImVec2(at.x - radius, at.y - radius));
    ImGui::SetNextWindowSize(ImVec2(2 * radius, 2 * radius));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("handle", ImVec2(2 * radius, 2 * radius));
    const bool held = ImGui::IsItemActive();
    const ImVec2 dragged = held ? ImGui::GetIO().MouseDelta : ImVec2(0, 0);
    reportSceneEdit(w, dragged.x != 0 || dragged.y != 0);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::GetBackgroundDrawList()->AddCircle(at, radius, IM_COL32(255, 255, 255, 235), 0, 1.5f * uiScale());
    ImGui::End();
    ImGui::PopStyleVar(2);
    return {dragged, held};
}

/// The distance of a drag along an axis, relative to the axis's length on the screen.
double shareOf(ImVec2 drag, ImVec2 axis) {
    const float pixels = lengthOf(axis);
    return static_cast<double>(drag.x * axis.x + drag.y * axis.y) / static_cast<double>(pixels * pixels);
}

/// The handles of a layer: their place, and the length of the arrows.
struct Gizmo {
    LayerId layer;
    Vec3 middle;
    double length;
};

/// Draws an arrow and moves the layer by a drag of its handle.
void drawArrow(Workspace& w, const Gizmo& gizmo, const GizmoAxis& axis) {
    const Vec3 along = gizmo.length * axis.direction;
    const auto start = onScreen(w, gizmo.middle), end = onScreen(w, gizmo.middle + along);
    if (!start || !end) return;
    const ImVec2 arrow(end->x - start->x, end->y - start->y);
    if (lengthOf(arrow) < kShortestArrow * uiScale()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine(*start, *end, axis.color, 2.5f * uiScale());
    list.AddCircleFilled(*end, 0.6f * kHandleRadius * uiScale(), axis.color);
    const ImVec2 drag = dragHandle(w, axis.move_id, *end, kHandleRadius * uiScale()).by;
    if (drag.x != 0 || drag.y != 0) moveLayer(w.scene, gizmo.layer, shareOf(drag, arrow) * along);
}

/// A point of the circle about an axis, at an angle from the next axis towards the one after that.
Vec3 onArc(const Gizmo& gizmo, std::size_t axis, double degrees) {
    const Vec3 x = kAxes[(axis + 1) % 3].direction, y = kAxes[(axis + 2) % 3].direction;
    const double radians = degrees * kDegree;
    return gizmo.middle + kArcRadius * gizmo.length * (std::cos(radians) * x + std::sin(radians) * y);
}

void drawArc(const Workspace& w, const Gizmo& gizmo, std::size_t axis) {
    for (int chord = 0; chord < kArcChords; ++chord) {
        const auto from = onScreen(w, onArc(gizmo, axis, 90.0 * chord / kArcChords));
        const auto to = onScreen(w, onArc(gizmo, axis, 90.0 * (chord + 1) / kArcChords));
        if (from && to) ImGui::GetBackgroundDrawList()->AddLine(*from, *to, kAxes[axis].color, 1.5f * uiScale());
    }
}

/// Draws an arc of a quarter turn and rotates the layer by a drag of its handle, which follows the mouse while it is
/// held.
void drawTurn(Workspace& w, const Gizmo& gizmo, std::size_t axis) {
    constexpr double kMiddle = 45;
    const float held_at = storedFloat(kAxes[axis].turn_id, 0); // degrees from the middle
    const double at = kMiddle + static_cast<double>(held_at);
    const auto place = onScreen(w, onArc(gizmo, axis, at)), ahead = onScreen(w, onArc(gizmo, axis, at + 1));
    if (!place || !ahead) return;
    const ImVec2 degree(ahead->x - place->x, ahead->y - place->y);
    const double radius_degrees = 1 / kDegree; // dragging as far as the radius rotates by one radian
    if (static_cast<double>(lengthOf(degree)) * radius_degrees < static_cast<double>(kShortestArrow * uiScale()))
        return;
    drawArc(w, gizmo, axis);
    ImGui::GetBackgroundDrawList()->AddCircleFilled(*place, 0.45f * kHandleRadius * uiScale(), kAxes[axis].color);
    const HandleDrag drag = dragHandle(w, kAxes[axis].turn_id, *place, 0.8f * kHandleRadius * uiScale());
    const double degrees = drag.held ? shareOf(drag.by, degree) : 0;
    storedFloat(kAxes[axis].turn_id, 0) = drag.held ? held_at + static_cast<float>(degrees) : 0;
    if (degrees != 0) turnLayer(w.scene, gizmo.layer, kAxes[axis].direction, degrees, w.scan_centres);
}

/// False for a layer that was deleted in this frame.
bool exists(const SceneDescription& scene, LayerId id) {
    const std::vector<LayerId> layers = layersOf(scene);
    return std::find(layers.begin(), layers.end(), id) != layers.end();
}

} // namespace

void drawGizmo(Workspace& w) {
    const std::optional<LayerId> layer = layerWithHandles();
    if (!layer || !exists(w.scene, *layer) || layerAt(w.scene, *layer).locked || !isLayerVisible(w.scene, *layer))
        return;
    const std::optional<Vec3> middle = layerMiddle(w.scene, *layer, w.scan_centres);
    if (!middle) return;
    const double length = arrowLength(w, *middle);
    if (!(length > 0)) return;
    const Gizmo gizmo{*layer, *middle, length};
    const bool turns = mayTurn(w.scene, *layer);
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        drawArrow(w, gizmo, kAxes[axis]);
        if (turns) drawTurn(w, gizmo, axis);
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Arrows over the picture that move the selected scan along the axes.
#include <imgui.h>

#include <array>
#include <cmath>
#include <optional>

#include "runtime/window/edit/placement_edit.h"
#include "runtime/window/ui/on_screen.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

struct GizmoAxis {
    const char* id;
    Vec3 direction;
    ImU32 color; ///< red, green and blue for x, y and z, as everywhere
};
constexpr std::array<GizmoAxis, 3> kAxes{{{"##move x", {1, 0, 0}, IM_COL32(235, 80, 80, 255)},
                                          {"##move y", {0, 1, 0}, IM_COL32(90, 200, 90, 255)},
                                          {"##move z", {0, 0, 1}, IM_COL32(90, 140, 245, 255)}}};
/// Length of the arrows as a share of the picture's height.
constexpr double kArrowShare = 0.12;
/// Radius of a handle in window units; a finger's width is twice as much.
constexpr float kHandleRadius = 9;
/// An axis that is seen nearly from its end cannot be dragged along: the fewest window units that its arrow takes.
constexpr float kShortestArrow = 12;

float lengthOf(ImVec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Length of the arrows in the scene, at a point.
double arrowLength(const Workspace& w, Vec3 at) {
    const double depth = dot(at - w.camera.eye, axesOf(w.camera).forward);
    const double height =
        w.camera.ortho_height > 0 ? w.camera.ortho_height : heightAtPivot(w.camera) * depth / distanceToPivot(w.camera);
    return kArrowShare * height;
}

/// A handle that takes the mouse from the picture. Returns how far it is dragged in this frame, which it reports as an
/// edit of the scene.
ImVec2 dragHandle(Workspace& w, const char* id, ImVec2 at, float radius) {
    ImGui::SetNextWindowPos(ImVec2(at.x - radius, at.y - radius));
    ImGui::SetNextWindowSize(ImVec2(2 * radius, 2 * radius));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("handle", ImVec2(2 * radius, 2 * radius));
    const ImVec2 dragged = ImGui::IsItemActive() ? ImGui::GetIO().MouseDelta : ImVec2(0, 0);
    reportSceneEdit(w, dragged.x != 0 || dragged.y != 0);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::GetBackgroundDrawList()->AddCircle(at, radius, IM_COL32(255, 255, 255, 235), 0, 1.5f * uiScale());
    ImGui::End();
    ImGui::PopStyleVar(2);
    return dragged;
}

/// Draws an arrow and moves the scan by a drag of its handle.
void drawArrow(Workspace& w, InstanceDescription& scan, Vec3 from, double length, const GizmoAxis& axis) {
    const auto start = onScreen(w, from), end = onScreen(w, from + length * axis.direction);
    if (!start || !end) return;
    const ImVec2 arrow(end->x - start->x, end->y - start->y);
    const float pixels = lengthOf(arrow);
    if (pixels < kShortestArrow * uiScale()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine(*start, *end, axis.color, 2.5f * uiScale());
    list.AddCircleFilled(*end, 0.6f * kHandleRadius * uiScale(), axis.color);
    const ImVec2 drag = dragHandle(w, axis.id, *end, kHandleRadius * uiScale());
    const double along =
        static_cast<double>(drag.x * arrow.x + drag.y * arrow.y) / static_cast<double>(pixels * pixels);
    scan.placement.translation = scan.placement.translation + along * length * axis.direction;
}

} // namespace

void drawGizmo(Workspace& w) {
    const std::optional<std::size_t> number = placedLayer();
    if (!number || *number >= w.scan_centres.size()) return;
    InstanceDescription& scan = w.scene.instances[*number];
    if (scan.layer.locked || !scan.visible || scan.deleted) return;
    const Vec3 middle = placed(scan.placement, w.scan_centres[*number]);
    const double length = arrowLength(w, middle);
    if (!(length > 0)) return;
    for (const GizmoAxis& axis : kAxes) drawArrow(w, scan, middle, length, axis);
}

} // namespace pointrt

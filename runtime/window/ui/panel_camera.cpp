// SPDX-License-Identifier: Apache-2.0
// The Camera section.
#include <imgui.h>

#include <string>

#include "runtime/window/input/camera_text.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

void showFitted(Workspace& w, const ViewCamera& view) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    w.camera = fittedView(view, {double(window.x), double(window.y)});
}

void standardViewButton(Workspace& w, const char* name, StandardView which, const char* tip = "") {
    if (columnButton(name, 4, false, tip)) showFitted(w, standardView(w.camera, which));
}

void drawStandardViews(Workspace& w) {
    standardViewButton(w, "Front", StandardView::kFront, "1");
    ImGui::SameLine();
    standardViewButton(w, "Right", StandardView::kRight, "3");
    ImGui::SameLine();
    standardViewButton(w, "Top", StandardView::kTop, "7");
    ImGui::SameLine();
    if (columnButton("Opposite", 4, false, "9: the opposite side")) showFitted(w, oppositeView(w.camera));
    standardViewButton(w, "Left", StandardView::kLeft);
    ImGui::SameLine();
    standardViewButton(w, "Back", StandardView::kBack);
    ImGui::SameLine();
    standardViewButton(w, "Bottom", StandardView::kBottom);
    ImGui::SameLine();
    standardViewButton(w, "Iso", StandardView::kIso, "from the right, the front and above");
}

void drawLens(Workspace& w) {
    bool ortho = w.camera.ortho_height > 0;
    if (checkboxRow("Orthographic", ortho, "5: parallel projection, so that lengths compare"))
        w.camera = orthoToggled(w.camera);
    if (ortho) return;
    double fov_deg = w.camera.fov_deg;
    if (sliderRow("Field of view", fov_deg, {1, 170}, "%.1f\xC2\xB0",
                  "vertical; objects at the orbit centre keep their size"))
        w.camera = withFov(w.camera, fov_deg, true);
    if (ImGui::IsItemActive()) w.requests.dragging = true;
}

} // namespace

void drawCamera(Workspace& w) {
    drawStandardViews(w);
    drawLens(w);
    const double size = sceneSize(w);
    valueRow("Eye", shownPoint(w, w.camera.eye, size).c_str());
    valueRow("Target", shownPoint(w, w.camera.pivot, size).c_str());
    valueRow("Distance", shownLength(w, distanceToPivot(w.camera), size).c_str());
    if (columnButton("Home", 2, false, "Home: the initial view")) w.requests.home = true;
    ImGui::SameLine();
    if (columnButton("Copy as text", 2, false, "Ctrl + C: copy the camera as pointrt-view options"))
        ImGui::SetClipboardText(cameraText(w.camera).c_str());
}

} // namespace pointrt

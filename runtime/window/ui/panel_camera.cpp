// SPDX-License-Identifier: Apache-2.0
// The Camera section.
#include <imgui.h>

#include <string>

#include "runtime/window/input/camera_text.h"
#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

void drawStandardViews(Workspace& w) {
    if (columnButton("Front", 4, false, "1")) w.camera = standardView(w.camera, StandardView::kFront);
    ImGui::SameLine();
    if (columnButton("Right", 4, false, "3")) w.camera = standardView(w.camera, StandardView::kRight);
    ImGui::SameLine();
    if (columnButton("Top", 4, false, "7")) w.camera = standardView(w.camera, StandardView::kTop);
    ImGui::SameLine();
    if (columnButton("Opposite", 4, false, "9: the opposite side")) w.camera = oppositeView(w.camera);
    if (columnButton("Left", 4, false)) w.camera = standardView(w.camera, StandardView::kLeft);
    ImGui::SameLine();
    if (columnButton("Back", 4, false)) w.camera = standardView(w.camera, StandardView::kBack);
    ImGui::SameLine();
    if (columnButton("Bottom", 4, false)) w.camera = standardView(w.camera, StandardView::kBottom);
    ImGui::SameLine();
    if (columnButton("Iso", 4, false, "from the right, the front and above"))
        w.camera = standardView(w.camera, StandardView::kIso);
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
    valueRow("Eye", pointText(w.camera.eye, size).c_str());
    valueRow("Target", pointText(w.camera.pivot, size).c_str());
    valueRow("Distance", lengthText(distanceToPivot(w.camera), size).c_str());
    if (columnButton("Home", 2, false, "Home: the initial view")) w.requests.home = true;
    ImGui::SameLine();
    if (columnButton("Copy as text", 2, false, "Ctrl + C: copy the camera as pointrt-view options"))
        ImGui::SetClipboardText(cameraText(w.camera).c_str());
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Light section: the list of lights.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "runtime/scene/layers.h"
#include "runtime/window/edit/light_edit.h"
#include "runtime/window/ui/layer_selection.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

/// Rows before the list scrolls.
constexpr int kMaxRows = 5;

/// Whether there is room for a light. Area lights count as shapes too, and a sky image counts as a light.
bool isRoomFor(const SceneDescription& scene, bool surface) {
    const std::size_t sky = scene.sky && !scene.sky->image.empty() ? 1 : 0;
    if (scene.lights.size() + sky >= MAX_LIGHTS) return false;
    return !surface || scene.shapes.size() + countSurfaces(scene.lights) < MAX_SHAPES;
}

LitScene litScene(const Workspace& w) {
    const ViewAxes axes = axesOf(w.camera);
    return {0.5 * (w.scene_min + w.scene_max),
            sceneUpright(w),
            0.5 * sceneSize(w),
            axes.right,
            axes.up,
            -1.0 * axes.forward};
}

int& selectedLight(const Workspace& w) {
    int& selected = storedInt("selected light", 0);
    selected = std::clamp(selected, 0, std::max(0, static_cast<int>(w.scene.lights.size()) - 1));
    return selected;
}

void addLight(Workspace& w, const LightDescription& light) {
    w.scene.lights.push_back(light);
    selectLayer({LayerKind::kLight, w.scene.lights.size() - 1});
    w.requests.scene_changed = true;
}

void drawSwatch(const LightDescription& light) {
    const Color tint = encodedColor(tintOf(light));
    const float side = ImGui::GetFontSize();
    const ImGuiColorEditFlags plain =
        ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoPicker | ImGuiColorEditFlags_NoDragDrop;
    ImGui::ColorButton("##tint", ImVec4(tint[0], tint[1], tint[2], 1), plain, ImVec2(side, side));
    ImGui::SameLine();
}

void drawList(Workspace& w) {
    const int count = static_cast<int>(w.scene.lights.size());
    if (count == 0) return dimText("No lights, only the sky.");
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float height = row * static_cast<float>(std::min(count, kMaxRows)) + 2 * ImGui::GetStyle().WindowPadding.y -
                         ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("lights", ImVec2(0, height), true);
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    for (int l = 0; l < count; ++l) {
        const LightDescription& light = w.scene.lights[static_cast<std::size_t>(l)];
        const LayerId id{LayerKind::kLight, static_cast<std::size_t>(l)};
        std::string name = layerAt(w.scene, id).name;
        if (name.empty()) name = std::string(namesOf(light.index()).label) + " " + std::to_string(l + 1);
        ImGui::PushID(l);
        drawSwatch(light);
        if (ImGui::Selectable(name.c_str(), l == selectedLight(w))) selectLayer(id);
        ImGui::PopID();
    }
    ImGui::PopStyleColor();
    ImGui::EndChild();
}

/// Area lights first, then the others, softest first.
std::array<std::size_t, kLightKinds> kindsBySoftness() {
    std::array<std::size_t, kLightKinds> kinds;
    std::iota(kinds.begin(), kinds.end(), std::size_t{0});
    const auto hard = std::stable_partition(kinds.begin(), kinds.end(), hasSurface);
    std::reverse(hard, kinds.end());
    return kinds;
}

void drawAddMenu(Workspace& w) {
    if (!ImGui::BeginPopup("add light")) return;
    for (const std::size_t kind : kindsBySoftness()) {
        const LightNames& names = namesOf(kind);
        if (ImGui::MenuItem(names.label, names.hint, false, isRoomFor(w.scene, hasSurface(kind))))
            addLight(w, newLight(kind, litScene(w)));
    }
    ImGui::EndPopup();
}

void drawButtons(Workspace& w) {
    const bool any = !w.scene.lights.empty();
    const auto selected = static_cast<std::size_t>(selectedLight(w));
    const bool surface = any && hasSurface(w.scene.lights[selected].index());
    if (columnButton("Add", 3)) ImGui::OpenPopup("add light");
    drawAddMenu(w);
    ImGui::SameLine();
    ImGui::BeginDisabled(!any || !isRoomFor(w.scene, surface));
    if (columnButton("Copy", 3, false, "duplicate the selected light"))
        addLight(w, LightDescription(w.scene.lights[selected]));
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!any || !mayDelete(w.scene, {LayerKind::kLight, selected}));
    if (columnButton("Delete", 3)) {
        deleteLayer(w.scene, {LayerKind::kLight, selected});
        w.requests.scene_changed = true;
    }
    ImGui::EndDisabled();
}

} // namespace

void drawLights(Workspace& w) {
    drawList(w);
    drawButtons(w);
    if (w.scene.lights.empty()) return;
    const int selected = selectedLight(w);
    ImGui::PushID(selected);
    const LayerId id{LayerKind::kLight, static_cast<std::size_t>(selected)};
    ImGui::BeginDisabled(layerAt(w.scene, id).locked);
    drawLightValues(w, w.scene.lights[id.number]);
    offerHandles(id);
    ImGui::EndDisabled();
    ImGui::PopID();
}

} // namespace pointrt

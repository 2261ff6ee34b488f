// SPDX-License-Identifier: Apache-2.0
// The Materials section: materials of scans and shapes.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "runtime/window/edit/material_edit.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

constexpr auto kScanKinds = [] {
    std::array<const char*, 1 + kMaterialKinds.size()> labels{"As scanned"};
    for (std::size_t i = 0; i < kMaterialKinds.size(); ++i) labels[1 + i] = kMaterialKinds[i].label;
    return labels;
}();
constexpr std::span<const char* const> kKinds = std::span(kScanKinds).subspan(1);

std::string fileName(const InstanceDescription& instance) {
    return std::filesystem::path(instance.path).filename().string();
}

/// The chosen instance (stored as 1-based index), or all (0).
InstanceRange chosenInstances(const SceneDescription& scene) {
    const auto count = scene.instances.size();
    if (count == 1) return {0, 1};
    int& chosen = storedInt("scan of materials", 0);
    chosen = std::clamp(chosen, 0, static_cast<int>(count));
    const std::string name = chosen == 0 ? "All" : fileName(scene.instances[static_cast<std::size_t>(chosen) - 1]);
    pushRow("Scan", "");
    if (ImGui::BeginCombo("##value", name.c_str())) {
        if (ImGui::Selectable("All", chosen == 0)) chosen = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::string row = std::to_string(i + 1) + "  " + fileName(scene.instances[i]);
            if (ImGui::Selectable(row.c_str(), chosen == static_cast<int>(i) + 1)) chosen = static_cast<int>(i) + 1;
        }
        ImGui::EndCombo();
    }
    popRow();
    return chosen == 0 ? InstanceRange{0, count} : InstanceRange{static_cast<std::size_t>(chosen) - 1, 1};
}

/// The material of all instances in range; none if they differ or have their files' materials.
std::optional<std::uint32_t> sharedMaterial(const SceneDescription& scene, InstanceRange range) {
    const auto material = scene.instances[range.first].material;
    for (std::size_t i = 1; i < range.count; ++i)
        if (scene.instances[range.first + i].material != material) return std::nullopt;
    return material && *material < scene.materials.size() ? material : std::nullopt;
}

void drawScan(Workspace& w) {
    const InstanceRange range = chosenInstances(w.scene);
    const auto first = w.scene.instances.begin() + static_cast<std::ptrdiff_t>(range.first);
    const bool is_locked = std::any_of(first, first + static_cast<std::ptrdiff_t>(range.count),
                                       [](const InstanceDescription& each) { return each.layer.locked; });
    ImGui::BeginDisabled(is_locked);
    auto material = sharedMaterial(w.scene, range);
    int kind = material ? 1 + static_cast<int>(w.scene.materials[*material].kind) : 0;
    if (reportSceneEdit(w,
                        comboRow("Material", kind, kScanKinds, "material of the whole scan, in place of the file's"))) {
        const auto new_kind = kind == 0 ? std::nullopt : std::optional(static_cast<MaterialKind>(kind - 1));
        setScanMaterial(w.scene, range, new_kind);
        material = sharedMaterial(w.scene, range);
    }
    if (material) drawMaterialValues(w, w.scene.materials[*material]);
    ImGui::EndDisabled();
}

void drawNamedMaterial(Workspace& w, std::uint32_t number) {
    const MaterialDescription& material = w.scene.materials[number];
    const std::string title =
        material.name.empty() ? std::string("material ") + std::to_string(number + 1) : material.name;
    ImGui::PushID(static_cast<int>(number));
    if (ImGui::TreeNode("material", "%s", title.c_str())) {
        drawShapeMaterial(w, number);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

} // namespace

void drawShapeMaterial(Workspace& w, std::uint32_t number) {
    MaterialDescription& material = w.scene.materials[number];
    int kind = static_cast<int>(material.kind);
    if (reportSceneEdit(w, comboRow("Kind", kind, kKinds))) material.kind = static_cast<MaterialKind>(kind);
    drawMaterialValues(w, material);
}

void drawMaterials(Workspace& w) {
    if (!hasScene(w)) dimText("No scene is open.");
    if (!w.scene.instances.empty()) drawScan(w);
    for (std::uint32_t m = 0; m < w.scene.materials.size(); ++m)
        if (usedByShapes(w.scene, m)) drawNamedMaterial(w, m);
}

} // namespace pointrt

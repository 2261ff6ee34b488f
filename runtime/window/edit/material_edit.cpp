// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/material_edit.h"

#include <algorithm>
#include <string>

#include "runtime/scene/material_fields.h"

namespace pointrt {
namespace {

/// Materials created here are named with this word and a number.
constexpr const char* kScanName = "scan";

std::string freeName(const SceneDescription& scene) {
    std::string name = kScanName;
    for (std::size_t number = 2; isMaterialNamed(scene, name); ++number)
        name = std::string(kScanName) + std::to_string(number);
    return name;
}

/// A material created here earlier that is no longer used, or a new one.
std::optional<std::uint32_t> spareMaterial(SceneDescription& scene, InstanceRange range) {
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
        if (scene.materials[m].name.starts_with(kScanName) && !usedBeside(scene, range, m)) return m;
    if (scene.materials.size() >= kMaxMaterials) return std::nullopt;
    scene.materials.push_back({});
    scene.materials.back().name = freeName(scene);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// The material of the range's first instance, if nothing outside the range uses it.
std::optional<std::uint32_t> ownMaterial(const SceneDescription& scene, InstanceRange range) {
    const auto material = scene.instances[range.first].material;
    if (!material || *material >= scene.materials.size() || usedBeside(scene, range, *material)) return std::nullopt;
    return material;
}

} // namespace

bool isMaterialNamed(const SceneDescription& scene, const std::string& name) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const MaterialDescription& material) { return material.name == name; });
}

bool usedByShapes(const SceneDescription& scene, std::uint32_t material) {
    return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                       [&](const ShapeDescription& shape) { return shape.material == material; });
}

bool usedBeside(const SceneDescription& scene, InstanceRange range, std::uint32_t material) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceDescription& instance = scene.instances[i];
        const bool inside = i >= range.first && i < range.first + range.count;
        if (!inside && instance.material == material) return true;
        for (const MaterialOverride& over : instance.overrides)
            if (over.material == material) return true;
    }
    return usedByShapes(scene, material);
}

MaterialDescription freshMaterial(MaterialKind kind) {
    MaterialDescription material;
    material.kind = kind;
    material.splat_color = !hasTrait(kind, MATERIAL_IS_CLEAR);
    material.color = hasTrait(kind, MATERIAL_REFRACTS) ? Color{1, 1, 1} : Color{0.9f, 0.9f, 0.9f};
    return material;
}

bool setScanMaterial(SceneDescription& scene, InstanceRange range, std::optional<MaterialKind> kind) {
    std::optional<std::uint32_t> material;
    if (kind) {
        material = ownMaterial(scene, range);
        if (!material) material = spareMaterial(scene, range);
        if (!material) return false;
        MaterialDescription fresh = freshMaterial(*kind);
        fresh.name = scene.materials[*material].name;
        scene.materials[*material] = fresh;
    }
    for (std::size_t i = 0; i < range.count; ++i) scene.instances[range.first + i].material = material;
    return true;
}

} // namespace pointrt

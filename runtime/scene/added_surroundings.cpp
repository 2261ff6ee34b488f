// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/added_surroundings.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace pointrt {
namespace {

/// Calls visit(number) for each reference to a material; visit may change the number.
template <typename Scene, typename Visit>
void eachMaterialUse(Scene& scene, const Visit& visit) {
    for (auto& shape : scene.shapes) visit(shape.material);
    for (auto& instance : scene.instances) {
        if (instance.material) visit(*instance.material);
        for (auto& over : instance.overrides) visit(over.material);
    }
}

SceneDescription withoutSurroundingShapes(SceneDescription scene) {
    std::erase_if(scene.shapes, [](const ShapeDescription& shape) { return shape.of_surroundings; });
    return scene;
}

std::set<std::uint32_t> surroundingMaterials(const SceneDescription& scene) {
    const SceneDescription rest = withoutSurroundingShapes(scene);
    std::set<std::uint32_t> materials;
    for (const ShapeDescription& shape : scene.shapes)
        if (shape.of_surroundings && !usesMaterial(rest, shape.material)) materials.insert(shape.material);
    return materials;
}

} // namespace

bool usesMaterial(const SceneDescription& scene, std::uint32_t material) {
    bool used = false;
    eachMaterialUse(scene, [&](std::uint32_t each) { used = used || each == material; });
    return used;
}

void moveSurroundingMaterialsLast(SceneDescription& scene) {
    const std::set<std::uint32_t> last = surroundingMaterials(scene);
    if (last.empty()) return;
    std::vector<std::uint32_t> order; // former numbers of the materials in their new order
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
        if (!last.contains(m)) order.push_back(m);
    order.insert(order.end(), last.begin(), last.end());
    std::vector<MaterialDescription> sorted;
    std::vector<std::uint32_t> number_of(order.size());
    for (const std::uint32_t former : order) {
        number_of[former] = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(scene.materials[former]);
    }
    scene.materials = std::move(sorted);
    eachMaterialUse(scene, [&](std::uint32_t& material) { material = number_of[material]; });
}

void removeSurroundings(SceneDescription& scene) {
    if (!scene.surroundings) return;
    if (scene.surroundings->has_lights) {
        scene.lights.clear();
        scene.suns.clear();
        scene.sky.reset();
    }
    const std::set<std::uint32_t> materials = surroundingMaterials(scene);
    scene = withoutSurroundingShapes(std::move(scene));
    while (!scene.materials.empty() && materials.contains(static_cast<std::uint32_t>(scene.materials.size() - 1)))
        scene.materials.pop_back();
    scene.render.room.reset();
    scene.render.lights.reset();
    scene.surroundings.reset();
}

} // namespace pointrt

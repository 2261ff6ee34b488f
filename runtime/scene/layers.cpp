// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/layers.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/scene/material_fields.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

constexpr std::array kKindWords = {"scan", "shape", "light", "clip", "measurement"};

/// Calls visit(layer, visible) with references to both members of the part.
template <typename Scene, typename Visit>
void visitLayer(Scene& scene, LayerId id, const Visit& visit) {
    switch (id.kind) {
    case LayerKind::kScan:
        return visit(scene.instances.at(id.number).layer, scene.instances.at(id.number).visible);
    case LayerKind::kShape:
        return visit(scene.shapes.at(id.number).layer, scene.shapes.at(id.number).visible);
    case LayerKind::kClip:
        return visit(scene.clips.at(id.number).layer, scene.clips.at(id.number).enabled);
    case LayerKind::kMeasure:
        return visit(scene.measures.at(id.number).layer, scene.measures.at(id.number).visible);
    case LayerKind::kLight:
        return std::visit([&](auto& light) { visit(light.layer, light.visible); }, scene.lights.at(id.number));
    }
}

template <typename Items>
void eraseAt(Items& items, std::size_t number) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(number));
}

/// The number of the scene's own scans and shapes. A scene file needs at least one of them.
std::size_t countBodies(const SceneDescription& scene) {
    const auto scans = std::count_if(scene.instances.begin(), scene.instances.end(),
                                     [](const InstanceDescription& each) { return !each.deleted; });
    const auto shapes = std::count_if(scene.shapes.begin(), scene.shapes.end(),
                                      [](const ShapeDescription& each) { return !each.of_surroundings; });
    return static_cast<std::size_t>(scans + shapes);
}

} // namespace

std::vector<LayerId> layersOf(const SceneDescription& scene) {
    std::vector<LayerId> layers;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!scene.instances[i].deleted) layers.push_back({LayerKind::kScan, i});
    const std::pair<LayerKind, std::size_t> others[] = {{LayerKind::kShape, scene.shapes.size()},
                                                        {LayerKind::kLight, scene.lights.size()},
                                                        {LayerKind::kClip, scene.clips.size()},
                                                        {LayerKind::kMeasure, scene.measures.size()}};
    for (const auto& [kind, count] : others)
        for (std::size_t i = 0; i < count; ++i) layers.push_back({kind, i});
    return layers;
}

std::string layerName(const SceneDescription& scene, LayerId id) {
    const std::string& name = layerAt(scene, id).name;
    if (!name.empty()) return name;
    if (id.kind == LayerKind::kScan)
        return std::filesystem::path(scene.instances.at(id.number).path).filename().string();
    return std::string(kKindWords.at(static_cast<std::size_t>(id.kind))) + " " + std::to_string(id.number + 1);
}

std::optional<LayerId> layerNamed(const SceneDescription& scene, const std::string& name) {
    for (const LayerId id : layersOf(scene))
        if (layerName(scene, id) == name) return id;
    return std::nullopt;
}

Layer& layerAt(SceneDescription& scene, LayerId id) {
    Layer* found = nullptr;
    visitLayer(scene, id, [&](Layer& layer, bool&) { found = &layer; });
    return *found;
}

const Layer& layerAt(const SceneDescription& scene, LayerId id) {
    const Layer* found = nullptr;
    visitLayer(scene, id, [&](const Layer& layer, bool) { found = &layer; });
    return *found;
}

bool isLayerVisible(const SceneDescription& scene, LayerId id) {
    bool shown = false;
    visitLayer(scene, id, [&](const Layer&, bool visible) { shown = visible; });
    return shown;
}

void setLayerVisible(SceneDescription& scene, LayerId id, bool visible) {
    visitLayer(scene, id, [&](Layer&, bool& member) { member = visible; });
}

std::vector<std::size_t> shownShapes(const SceneDescription& scene) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < scene.shapes.size(); ++i)
        if (scene.shapes[i].visible) shown.push_back(i);
    return shown;
}

bool mayAddShape(const SceneDescription& scene) {
    return scene.shapes.size() + countSurfaces(scene.lights) < MAX_SHAPES && scene.materials.size() < kMaxMaterials;
}

bool mayDelete(const SceneDescription& scene, LayerId id) {
    if (layerAt(scene, id).locked) return false;
    const bool is_body =
        id.kind == LayerKind::kScan || (id.kind == LayerKind::kShape && !scene.shapes.at(id.number).of_surroundings);
    return !is_body || countBodies(scene) > 1;
}

void deleteLayer(SceneDescription& scene, LayerId id) {
    switch (id.kind) {
    case LayerKind::kScan:
        scene.instances.at(id.number).deleted = true;
        break;
    case LayerKind::kShape:
        eraseAt(scene.shapes, id.number);
        break;
    case LayerKind::kLight:
        eraseAt(scene.lights, id.number);
        break;
    case LayerKind::kClip:
        eraseAt(scene.clips, id.number);
        break;
    case LayerKind::kMeasure:
        eraseAt(scene.measures, id.number);
        break;
    }
}

void hideLayers(SceneDescription& scene, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (const auto id = layerNamed(scene, name)) {
            setLayerVisible(scene, *id, false);
            continue;
        }
        std::string known;
        for (const LayerId id : layersOf(scene)) known += (known.empty() ? "" : ", ") + layerName(scene, id);
        throw Error{ExitCode::kBadUsage,
                    "--hide: " + scene.path + " has no \"" + printable(name) + "\"; it has " + printable(known)};
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "runtime/scene_file/values.h"
#include "runtime/scene_file/write_parts.h"

namespace pointrt {
namespace {

/// True for what the reader makes for shapes that name no material, and where that is all it is for.
bool isPlain(const SceneDescription& scene, std::uint32_t material) {
    if (scene.materials[material] != MaterialDescription{}) return false;
    return std::none_of(scene.instances.begin(), scene.instances.end(), [&](const InstanceDescription& instance) {
        return instance.material == material ||
               std::any_of(instance.overrides.begin(), instance.overrides.end(),
                           [&](const MaterialOverride& over) { return over.material == material; });
    });
}

const char* nameOfKind(MaterialKind kind) {
    constexpr const char* names[] = {"matte", "metal", "plastic", "mirror", "glass"};
    return names[static_cast<std::size_t>(kind)];
}

/// In quotes where TOML needs them.
std::string keyOf(const std::string& name) {
    constexpr const char* bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return name.find_first_not_of(bare) == std::string::npos ? name : tomlOf(name);
}

void putGlass(SceneWriting& writing, const MaterialDescription& material) {
    put(writing, "index", tomlOf(material.index));
    if (material.thin)
        put(writing, "thin", "true");
    else
        put(writing, "absorption", tomlOf(material.absorption));
}

void putKind(SceneWriting& writing, const MaterialDescription& material) {
    switch (material.kind) {
    case MaterialKind::kMatte:
        put(writing, "mirror_share", tomlOf(material.mirror_share));
        put(writing, "specular", tomlOf(material.specular));
        put(writing, "shininess", tomlOf(material.shininess));
        return;
    case MaterialKind::kPlastic:
        put(writing, "index", tomlOf(material.index));
        [[fallthrough]];
    case MaterialKind::kMetal:
        put(writing, "roughness", tomlOf(material.roughness));
        return;
    case MaterialKind::kGlass:
        return putGlass(writing, material);
    case MaterialKind::kMirror:
        return;
    }
}

} // namespace

std::vector<std::string> materialNames(const SceneDescription& scene) {
    std::set<std::string> taken{""};
    for (const MaterialDescription& material : scene.materials) taken.insert(material.name);
    std::set<std::string> given;
    std::vector<std::string> names;
    bool plain_taken = false;
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
        std::string name = scene.materials[m].name;
        const bool plain = !plain_taken && isPlain(scene, m);
        plain_taken = plain_taken || plain;
        if (!plain && (name.empty() || name != printable(name) || given.count(name)))
            for (int number = 1; taken.count(name) || name != printable(name); ++number)
                name = "material " + std::to_string(number);
        taken.insert(name);
        given.insert(name);
        names.push_back(name);
    }
    return names;
}

void writeMaterials(SceneWriting& writing) {
    for (std::size_t m = 0; m < writing.material_names.size(); ++m) {
        if (writing.material_names[m].empty()) continue;
        const MaterialDescription& material = writing.scene.materials[m];
        begin(writing, "[material." + keyOf(writing.material_names[m]) + "]");
        put(writing, "kind", std::string("\"") + nameOfKind(material.kind) + "\"");
        put(writing, "color", tomlOf(material.color));
        if (material.splat_color) put(writing, "splat_color", "true");
        if (material.emission != Color{0, 0, 0}) put(writing, "emission", tomlOf(material.emission));
        putKind(writing, material);
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "format/base/printable.h"
#include "runtime/scene/material_fields.h"
#include "runtime/scene_io/values.h"
#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

/// True for the default material of shapes, unless instances use it too.
bool isDefault(const SceneDescription& scene, std::uint32_t material) {
    if (scene.materials[material] != MaterialDescription{}) return false;
    return std::none_of(scene.instances.begin(), scene.instances.end(), [&](const InstanceDescription& instance) {
        return instance.material == material ||
               std::any_of(instance.overrides.begin(), instance.overrides.end(),
                           [&](const MaterialOverride& over) { return over.material == material; });
    });
}

/// name in quotes if TOML needs them.
std::string keyOf(const std::string& name) {
    constexpr const char* bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return name.find_first_not_of(bare) == std::string::npos ? name : tomlOf(name);
}

/// Switches that are off are omitted.
void putField(SceneWriting& writing, const MaterialField& field, const MaterialDescription& material) {
    if (field.unless && material.*field.unless) return;
    if (const auto* number = std::get_if<float MaterialDescription::*>(&field.member))
        put(writing, field.key, tomlOf(material.**number));
    if (const auto* flag = std::get_if<bool MaterialDescription::*>(&field.member); flag && material.**flag)
        put(writing, field.key, "true");
    if (const auto* color = std::get_if<Color MaterialDescription::*>(&field.member))
        put(writing, field.key, tomlOf(material.**color));
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
        const bool plain = !plain_taken && isDefault(scene, m);
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
        put(writing, "kind", std::string("\"") + rowOf(material.kind).word + "\"");
        put(writing, "color", tomlOf(material.color));
        if (material.splat_color) put(writing, "splat_color", "true");
        if (material.emission != Color{0, 0, 0}) put(writing, "emission", tomlOf(material.emission));
        for (const MaterialField* field : writtenFieldsOf(material.kind)) putField(writing, *field, material);
    }
}

} // namespace pointrt

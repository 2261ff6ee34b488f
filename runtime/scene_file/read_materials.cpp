// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "runtime/scene_file/read_parts.h"

namespace pointrt {
namespace {

/// A kind's name and the keys that mean something to it.
struct Kind {
    MaterialKind kind;
    std::string_view name;
    std::vector<std::string_view> keys;
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {MaterialKind::kMatte, "matte", {"mirror_share", "specular", "shininess"}},
        {MaterialKind::kMetal, "metal", {"roughness"}},
        {MaterialKind::kPlastic, "plastic", {"roughness", "index"}},
        {MaterialKind::kMirror, "mirror", {}},
        {MaterialKind::kGlass, "glass", {"index", "thin", "absorption", "tint", "tint_distance"}},
    };
    return all;
}

const Kind& kindOf(const SceneValue& table) {
    std::vector<std::string_view> names;
    for (const Kind& each : kinds()) names.push_back(each.name);
    const auto value = find(table, "kind");
    return kinds()[value ? choiceOf(*value, names) : 0];
}

/// Beer-Lambert: what is left of tint after tint_distance inside.
Color absorptionOfTint(const SceneValue& table, const SceneValue& tint_value) {
    double distance = 1;
    takeNumber(table, "tint_distance", kLengths, distance);
    const Color tint = colorOf(tint_value);
    Color absorption;
    for (std::size_t i = 0; i < tint.size(); ++i) {
        if (!(tint[i] > 0)) refuse(tint_value, "must be above 0 in red, green and blue: some light comes through");
        absorption[i] = static_cast<float>(-std::log(static_cast<double>(tint[i])) / distance);
    }
    return absorption;
}

void readGlass(const SceneValue& table, MaterialDescription& material) {
    takeFlag(table, "thin", material.thin);
    takeColor(table, "absorption", kLight, material.absorption);
    if (material.thin)
        forbid(table, {"absorption", "tint", "tint_distance"}, "a thin pane has no inside that absorbs; use \"color\"");
    const auto tint = find(table, "tint");
    if (!tint) return forbid(table, {"tint_distance"}, "says nothing without \"tint\"");
    forbid(table, {"absorption"}, "excludes \"tint\"");
    material.absorption = absorptionOfTint(table, *tint);
}

/// Matte, metal and plastic splats keep their own colours unless the file gives one. Where those rule, or light is only
/// reflected and let through, nothing is taken off by default.
void readColor(const SceneValue& table, MaterialDescription& material) {
    const bool colored = find(table, "color").has_value();
    const bool clear = material.kind == MaterialKind::kMirror || material.kind == MaterialKind::kGlass;
    material.splat_color = !colored && !clear;
    takeFlag(table, "splat_color", material.splat_color);
    if (material.splat_color || clear) material.color = {1, 1, 1};
    takeColor(table, "color", kShare, material.color);
}

MaterialDescription readMaterial(const SceneValue& table) {
    const Kind& kind = kindOf(table);
    std::vector<std::string_view> keys = {"kind", "color", "splat_color", "emission"};
    keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
    requireKnownKeys(table, "a material of kind \"" + std::string(kind.name) + "\"", keys);

    MaterialDescription material;
    material.kind = kind.kind;
    readColor(table, material);
    takeNumber(table, "roughness", kShare, material.roughness);
    takeNumber(table, "index", {1, 4}, material.index);
    takeNumber(table, "mirror_share", kShare, material.mirror_share);
    takeNumber(table, "specular", kShare, material.specular);
    takeNumber(table, "shininess", {1, 1000}, material.shininess);
    takeColor(table, "emission", kLight, material.emission);
    if (kind.kind == MaterialKind::kGlass) readGlass(table, material);
    return material;
}

} // namespace

void readMaterials(const SceneValue& file, SceneReading& reading) {
    const auto all = findTable(file, "material");
    if (!all) return;
    for (const auto& [name, table] : membersOf(*all)) {
        if (!table.node->is_table()) refuse(table, "must be a table, begun with [material.NAME]");
        if (name.empty() || name != printable(name)) refuse(table, "is no name for a material");
        if (reading.scene.materials.size() == kMaxMaterials) refuse(table, "there are at most 256 materials");
        const auto number = static_cast<std::uint32_t>(reading.scene.materials.size());
        reading.scene.materials.push_back(readMaterial(table));
        reading.scene.materials.back().name = name;
        reading.material_of_name[name] = number;
        if (reading.scene.materials.back().splat_color && !find(table, "color"))
            reading.uncolored_materials.insert(number);
    }
}

std::uint32_t materialOf(const SceneValue& value, const SceneReading& reading) {
    const std::string name = textOf(value);
    const auto found = reading.material_of_name.find(name);
    if (found != reading.material_of_name.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [known, number] : reading.material_of_name) names.push_back(known);
    const std::string near = suggestion(name, names);
    refuse(value, "there is no [material." + printable(name) + "]" + near);
}

} // namespace pointrt

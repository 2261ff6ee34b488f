// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "format/base/printable.h"
#include "runtime/scene/material_fields.h"
#include "runtime/scene_io/read_parts.h"

namespace pointrt {
namespace {

constexpr std::string_view kAbsorption = "absorption";

const MaterialKindRow& materialKindOf(const SceneValue& table) {
    std::vector<std::string_view> words;
    for (const MaterialKindRow& each : kMaterialKinds) words.push_back(each.word);
    const auto value = find(table, "kind");
    return kMaterialKinds[value ? choiceOf(*value, words) : 0];
}

/// The keys of a kind.
std::vector<std::string_view> keysOf(MaterialKind kind) {
    std::vector<std::string_view> keys = {"kind", "color", "splat_color", "emission"};
    for (const MaterialField* field : fieldsOf(kind)) {
        keys.push_back(field->key);
        if (field->key == kAbsorption) keys.insert(keys.end(), {"tint", "tint_distance"});
    }
    return keys;
}

/// The absorption coefficient of a transmittance tint over tint_distance, by the Beer-Lambert law.
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

/// Reads a tint, the alternative to an absorption coefficient.
void readTint(const SceneValue& table, MaterialDescription& material) {
    if (material.thin)
        forbid(table, {"absorption", "tint", "tint_distance"}, "a thin pane has no inside that absorbs; use \"color\"");
    const auto tint = find(table, "tint");
    if (!tint) return forbid(table, {"tint_distance"}, "has no effect without \"tint\"");
    forbid(table, {"absorption"}, "cannot be combined with \"tint\"");
    material.absorption = absorptionOfTint(table, *tint);
}

void readField(const SceneValue& table, const MaterialField& field, MaterialDescription& material) {
    const Range range{field.low, field.high};
    if (const auto* number = std::get_if<float MaterialDescription::*>(&field.member))
        takeNumber(table, field.key, range, material.**number);
    if (const auto* flag = std::get_if<bool MaterialDescription::*>(&field.member))
        takeFlag(table, field.key, material.**flag);
    if (const auto* color = std::get_if<Color MaterialDescription::*>(&field.member))
        takeColor(table, field.key, range, material.**color);
    if (field.key == kAbsorption) readTint(table, material);
}

/// Matte, metal and plastic use the splats' colours unless "color" is given. With splat colours, and for mirrors and
/// glass, "color" defaults to white.
void readColor(const SceneValue& table, MaterialDescription& material) {
    const bool colored = find(table, "color").has_value();
    const bool clear = hasTrait(material.kind, MATERIAL_IS_CLEAR);
    material.splat_color = !colored && !clear;
    takeFlag(table, "splat_color", material.splat_color);
    if (material.splat_color || clear) material.color = {1, 1, 1};
    takeColor(table, "color", kShares, material.color);
}

MaterialDescription readMaterial(const SceneValue& table) {
    const MaterialKindRow& kind = materialKindOf(table);
    requireKnownKeys(table, "a material of kind \"" + std::string(kind.word) + "\"", keysOf(kind.kind));

    MaterialDescription material;
    material.kind = kind.kind;
    readColor(table, material);
    takeColor(table, "emission", kLightValues, material.emission);
    for (const MaterialField* field : fieldsOf(kind.kind)) readField(table, *field, material);
    return material;
}

} // namespace

void readMaterials(const SceneValue& file, SceneReading& reading) {
    const auto all = findTable(file, "material");
    if (!all) return;
    for (const auto& [name, table] : membersOf(*all)) {
        if (!table.node->is_table()) refuse(table, "must be a table, begun with [material.NAME]");
        if (name.empty() || name != printable(name)) refuse(table, "is not a valid name of a material");
        if (reading.scene.materials.size() == kMaxMaterials) refuse(table, "more than 256 materials");
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

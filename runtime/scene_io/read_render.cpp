// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/read_parts.h"

namespace pointrt {
namespace {

std::uint32_t readValue(const SceneValue& value, CountRange range) {
    return wholeNumberOf(value, range.low, range.high);
}

float readValue(const SceneValue& value, RealRange range) {
    return static_cast<float>(numberOf(value, {range.low, range.high}));
}

PixelSize readValue(const SceneValue& value, SizeRange range) {
    if (!value.node->is_array() || value.node->as_array()->size() != 2) refuse(value, "must be [width, height]");
    const std::vector<SceneValue> sides = elementsOf(value);
    return {wholeNumberOf(sides[0], 1, range.longest), wholeNumberOf(sides[1], 1, range.longest)};
}

std::string readValue(const SceneValue& value, AttributeWord) { return textOf(value); }

ValueRange readValue(const SceneValue& value, RangeOfValues) { return rangeOf(value); }

Background readValue(const SceneValue& value, BackgroundWord word) {
    try {
        return parseValue(word, textOf(value));
    } catch (const std::invalid_argument& error) {
        refuse(value, error.what());
    }
}

bool readValue(const SceneValue& value, OneOf<bool>) { return flagOf(value); }

template <typename Named>
Named readValue(const SceneValue& value, OneOf<Named> choices) {
    return nameChoiceOf(value, choices.names);
}

} // namespace

std::vector<std::string_view> settingKeys(FileTable table) {
    std::map<int, std::string_view> keys;
    forEachRenderSetting([&](const auto& row) {
        if (row.scene_file.table == table) keys[row.scene_file.place] = row.scene_file.key;
    });
    std::vector<std::string_view> in_order;
    for (const auto& [place, key] : keys) in_order.push_back(key);
    return in_order;
}

void readSettings(const SceneValue& values, FileTable table, RenderChoices& choices) {
    forEachRenderSetting([&](const auto& row) {
        if (row.scene_file.table != table) return;
        if (const auto value = find(values, row.scene_file.key)) choices.*row.choice = readValue(*value, row.limits);
    });
}

void readRender(const SceneValue& file, SceneDescription& scene) {
    const auto table = findTable(file, "render");
    if (!table) return;
    requireKnownKeys(*table, "render", settingKeys(FileTable::kRender));
    readSettings(*table, FileTable::kRender, scene.render);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

std::string settingText(CountRange, std::uint32_t value) { return tomlOf(value); }
std::string settingText(RealRange, float value) { return tomlOf(value); }
std::string settingText(SizeRange, PixelSize value) { return listOf({tomlOf(value.width), tomlOf(value.height)}); }
std::string settingText(AttributeWord, const std::string& value) { return tomlOf(value); }
std::string settingText(RangeOfValues, ValueRange value) { return listOf({tomlOf(value.low), tomlOf(value.high)}); }
std::string settingText(BackgroundWord word, const Background& value) { return tomlOf(valueText(word, value)); }
std::string settingText(OneOf<bool>, bool value) { return tomlOf(value); }
template <typename Named>
std::string settingText(OneOf<Named> choices, Named value) {
    return tomlOf(valueText(choices, value));
}

} // namespace

void writeSettings(SceneWriting& writing, FileTable table) {
    struct Line {
        const char* key;
        std::string value;
    };
    std::map<int, Line> lines;
    forEachRenderSetting([&](const auto& row) {
        const auto& choice = writing.scene.render.*row.choice;
        if (row.scene_file.table == table && choice)
            lines[row.scene_file.place] = {row.scene_file.key, settingText(row.limits, *choice)};
    });
    for (const auto& [place, line] : lines) put(writing, line.key, line.value);
}

void writeRender(SceneWriting& writing) {
    begin(writing, "[render]");
    writeSettings(writing, FileTable::kRender);
}

} // namespace pointrt

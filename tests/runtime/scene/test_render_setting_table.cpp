// SPDX-License-Identifier: Apache-2.0
// The command line, --help, scene files and docs/SCENES.md agree with the table of settings.
#include "runtime/scene/render_setting_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "format/base/error.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/session/options.h"

namespace pointrt {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> linesOf(std::istream&& text) {
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

const std::vector<std::string>& helpLines() {
    static const std::vector<std::string> lines = [] {
        const char* const arguments[] = {"pointrt-view", "--help"};
        Options options;
        testing::internal::CaptureStdout();
        EXPECT_EQ(parseOptions(2, arguments, options), 0);
        return linesOf(std::istringstream(testing::internal::GetCapturedStdout()));
    }();
    return lines;
}

/// The help of an option, joined to one line.
std::string helpOf(const std::string& option) {
    std::string help;
    for (const std::string& line : helpLines()) {
        if (line.starts_with("  " + option + " "))
            help = line;
        else if (!help.empty() && line.starts_with("    "))
            help += line.substr(line.find_first_not_of(' ') - 1);
        else if (!help.empty())
            break;
    }
    return help;
}

/// Rows of docs/SCENES.md: key, default and description, without back quotes. A row may have several keys, separated by
/// commas.
std::vector<std::string> docOf(const std::string& key) {
    for (const std::string& line : linesOf(std::ifstream(POINTRT_SCENES_DOC))) {
        std::vector<std::string> columns;
        std::istringstream row(line);
        for (std::string column; std::getline(row, column, '|');) columns.push_back(column);
        if (columns.size() < 4 || !contains(columns[1], "`" + key + "`")) continue;
        for (std::string& column : columns) std::erase(column, '`');
        return {columns[1], columns[2], columns[3]};
    }
    return {"", "", ""};
}

/// Defaults by key, as written in scene files.
std::map<std::string, std::string> writtenDefaults() {
    SceneDescription scene;
    scene.render = choicesOf({});
    std::map<std::string, std::string> values;
    for (const std::string& line : linesOf(std::istringstream(sceneText(scene, ""))))
        if (contains(line, " = ")) values[line.substr(0, line.find(" = "))] = line.substr(line.find(" = ") + 3);
    return values;
}

/// All words that help must contain for these limits: the numbers or the names.
template <typename Limits>
std::vector<std::string> limitWords(const Limits& limits) {
    return {limitsText(limits)};
}
template <typename Named>
std::vector<std::string> limitWords(const OneOf<Named>& choices) {
    const std::vector<std::string_view> words = wordsOf(choices.names);
    return {words.begin(), words.end()};
}

TEST(RenderSettingTable, AgreesWithHelp) {
    forEachRenderSetting([](const auto& row) {
        const std::string option = row.command_line.option, help = helpOf(option);
        EXPECT_FALSE(help.empty()) << option;
        EXPECT_FALSE(contains(help, "{")) << help;
        const auto standard = settingOf(RenderSettings{}, row.member);
        EXPECT_TRUE(contains(help, standard ? "(default " + valueText(row.limits, *standard) : "(default")) << help;
        if (option == "--reflectivity") // its help explains both limits
            EXPECT_TRUE(contains(help, "0 (matte) to 1 (mirror)") && limitsText(row.limits) == "0 to 1") << help;
        else
            for (const std::string& word : limitWords(row.limits)) EXPECT_TRUE(contains(help, word)) << option << word;
    });
}

TEST(RenderSettingTable, AgreesWithTheDocumentationOfSceneFiles) {
    std::map<std::string, std::string> defaults = writtenDefaults();
    forEachRenderSetting([&](const auto& row) {
        const std::string key = row.scene_file.key;
        const std::vector<std::string> doc = docOf(key);
        EXPECT_TRUE(contains(doc[0], key)) << key;
        if (settingOf(RenderSettings{}, row.member)) {
            EXPECT_EQ(doc[1], " " + defaults[key] + " ") << key;
        }
        EXPECT_GT(doc[1].size(), 2u) << key;
        if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(row)>::Value, bool>) {
            EXPECT_TRUE(contains(doc[2], "false")) << key;
        } else {
            for (const std::string& word : limitWords(row.limits)) EXPECT_TRUE(contains(doc[2], word)) << key << word;
        }
    });
}

std::vector<std::string> extremes(CountRange range) { return {std::to_string(range.low), std::to_string(range.high)}; }
std::vector<std::string> extremes(RealRange range) { return {plainText(range.low), plainText(range.high)}; }
std::vector<std::string> extremes(SizeRange range) {
    return {"1x" + std::to_string(range.longest), std::to_string(range.longest) + "x1"};
}
std::vector<std::string> extremes(AttributeWord) { return {"height", "größe \"a\"", "rgb16.2"}; }
std::vector<std::string> extremes(RangeOfValues) { return {"-1,2.5", "1e-300,1e+300", "0.1,0.30000000000000004"}; }
std::vector<std::string> extremes(BackgroundWord) { return {"black", "white", "transparent", "#0a80ff"}; }
template <typename Named>
std::vector<std::string> extremes(OneOf<Named> choices) {
    return limitWords(choices);
}

std::vector<std::string> beyond(CountRange range) {
    return {std::to_string(std::int64_t{range.low} - 1), std::to_string(std::int64_t{range.high} + 1)};
}
std::vector<std::string> beyond(RealRange range) { return {plainText(range.low - 0.1), plainText(range.high + 0.1)}; }
std::vector<std::string> beyond(SizeRange range) { return {"0x1", "1x" + std::to_string(range.longest + 1)}; }
std::vector<std::string> beyond(AttributeWord) { return {""}; }
std::vector<std::string> beyond(RangeOfValues) { return {"1,1", "2,1", "nan,1"}; }
std::vector<std::string> beyond(BackgroundWord) { return {"", "grey", "#12345", "#12345g"}; }
template <typename Named>
std::vector<std::string> beyond(OneOf<Named>) {
    return {"nonsense", ""};
}

RenderChoices said(const std::string& option, const std::string& value) {
    const char* const arguments[] = {"pointrt-view", "a.pro", option.c_str(), value.c_str()};
    Options options;
    EXPECT_FALSE(parseOptions(4, arguments, options));
    return options.choices;
}

/// The choices after writing and reading a scene file.
RenderChoices filed(const RenderChoices& choices) {
    SceneDescription scene;
    scene.render = choices;
    scene.shapes.resize(1);
    scene.materials.resize(1);
    return parseScene(sceneText(scene, ""), "scene.toml").render;
}

/// A value of the command line as written in a scene file.
template <typename Limits>
std::string inFile(const Limits&, const std::string& text) {
    return text;
}
std::string inFile(SizeRange, const std::string& text) {
    return "[" + text.substr(0, text.find('x')) + ", " + text.substr(text.find('x') + 1) + "]";
}
std::string inFile(AttributeWord, const std::string& text) { return "\"" + text + "\""; }
std::string inFile(RangeOfValues, const std::string& text) { return "[" + text + "]"; }
std::string inFile(BackgroundWord, const std::string& text) { return "\"" + text + "\""; }
template <typename Named>
std::string inFile(OneOf<Named>, const std::string& text) {
    return "\"" + text + "\"";
}

std::string sceneSaying(const InSceneFile& place, const std::string& value) {
    const std::string line = std::string(place.key) + " = " + value + "\n";
    return place.table == FileTable::kScene ? line : "[render]\n" + line;
}

TEST(RenderSettingTable, CommandLineAndSceneFilesAcceptTheSameValues) {
    forEachRenderSetting([](const auto& row) {
        for (const std::string& text : extremes(row.limits)) {
            const RenderChoices choices = said(row.command_line.option, text);
            ASSERT_TRUE(choices.*row.choice) << row.command_line.option;
            EXPECT_EQ(valueText(row.limits, *(choices.*row.choice)), text);
            EXPECT_EQ(filed(choices), choices) << row.scene_file.key;
            RenderSettings settings;
            applyChoices(choices, settings);
            EXPECT_EQ(settingOf(settings, row.member), choices.*row.choice) << row.command_line.option;
        }
        for (const std::string& text : beyond(row.limits)) {
            EXPECT_THROW(said(row.command_line.option, text), Error) << row.command_line.option;
            const std::string scene = sceneSaying(row.scene_file, inFile(row.limits, text));
            try {
                parseScene(scene, "scene.toml");
                ADD_FAILURE() << scene;
            } catch (const Error& error) {
                EXPECT_TRUE(contains(error.what(), row.scene_file.key)) << error.what();
            }
        }
    });
}

TEST(RenderSettingTable, ChoicesReproduceSettings) {
    RenderSettings settings;
    settings.room = Room::kMatte;
    settings.lights = 5;
    settings.reflectivity = 0.5f;
    settings.width = 7;
    RenderSettings copy;
    applyChoices(choicesOf(settings), copy);
    EXPECT_EQ(choicesOf(copy), choicesOf(settings));
    EXPECT_EQ(copy.width, 7u);
    EXPECT_FALSE(choicesOf({}).room) << "the scene decides";
}

} // namespace
} // namespace pointrt

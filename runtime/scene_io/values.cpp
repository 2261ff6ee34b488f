// SPDX-License-Identifier: Apache-2.0
#define TOML_IMPLEMENTATION
#include "runtime/scene_io/values.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "format/base/error.h"
#include "format/base/near_name.h"
#include "format/base/printable.h"

namespace pointrt {
namespace {

std::string place(const std::string& file, const toml::source_region& region) {
    return file + ":" + std::to_string(std::max<toml::source_index>(1, region.begin.line)) + ": ";
}

/// toml++ nests a table for each dot of a key and frees these tables recursively: half a megabyte of "a.a.a." overflows
/// the stack. No key of a scene file has more than two dots.
void requireFewDots(std::string_view text, const std::string& file) {
    constexpr int most = 64;
    std::uint32_t line = 1;
    int dots = 0;
    for (char c : text) {
        if (c == '.') ++dots;
        if (std::string_view("\n,=[]{}").find(c) != std::string_view::npos) dots = 0;
        if (c == '\n') ++line;
        if (dots > most)
            throw Error{ExitCode::kBadInput, file + ":" + std::to_string(line) + ": more than 64 dots in a row"};
    }
}

} // namespace

std::string joined(const std::vector<std::string_view>& words) {
    std::string text;
    for (std::string_view word : words) {
        if (!text.empty()) text += ", ";
        text += word;
    }
    return text;
}

std::string suggestion(std::string_view text, const std::vector<std::string_view>& names) {
    const std::string_view nearest = nearestName(text, names);
    return nearest.empty() ? "" : ", did you mean \"" + printable(nearest) + "\"?";
}

std::string placeOf(const SceneValue& value) {
    const std::string key = value.name.empty() ? "" : "key \"" + value.name + "\": ";
    return place(*value.file, value.node->source()) + key;
}

void refuse(const SceneValue& value, const std::string& reason) {
    throw Error{ExitCode::kBadInput, placeOf(value) + reason};
}

toml::table parseToml(std::string_view text, const std::string& file) {
    requireFewDots(text, file);
    try {
        return toml::parse(text, std::string_view(file));
    } catch (const toml::parse_error& error) {
        throw Error{ExitCode::kBadInput,
                    place(file, error.source()) + printable(error.description(), std::string::npos)};
    } catch (const std::logic_error& error) { // see toml_defined.h
        throw Error{ExitCode::kBadInput, file + ": " + error.what()};
    }
}

std::optional<SceneValue> find(const SceneValue& table, std::string_view key) {
    const toml::node* node = table.node->as_table()->get(key);
    if (!node) return {};
    return SceneValue{table.file, node, (table.name.empty() ? "" : table.name + ".") + printable(key)};
}

SceneValue require(const SceneValue& table, std::string_view key) {
    if (const auto value = find(table, key)) return *value;
    refuse(table, "\"" + std::string(key) + "\" is missing");
}

bool hasFirst(const SceneValue& table, std::string_view first, std::string_view second) {
    const auto a = find(table, first), b = find(table, second);
    if (a && b) refuse(*b, "cannot be combined with \"" + std::string(first) + "\"");
    if (!a && !b) refuse(table, "\"" + std::string(first) + "\" or \"" + std::string(second) + "\" is missing");
    return a.has_value();
}

void requireKnownKeys(const SceneValue& table, const std::string& owner, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : membersOf(table)) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        const std::string near = suggestion(key, known);
        refuse(value, "unknown key \"" + printable(key) + "\"" +
                          (near.empty() ? "; " + owner + " has " + joined(known) : near));
    }
}

void forbid(const SceneValue& table, std::initializer_list<std::string_view> keys, const std::string& reason) {
    for (std::string_view key : keys)
        if (const auto value = find(table, key)) refuse(*value, reason);
}

void requireTable(const SceneValue& value) {
    if (!value.node->is_table()) refuse(value, "must be a table");
}

std::optional<SceneValue> findTable(const SceneValue& table, std::string_view key) {
    auto value = find(table, key);
    if (value) requireTable(*value);
    return value;
}

std::vector<SceneValue> findTables(const SceneValue& table, std::string_view key) {
    const auto list = find(table, key);
    if (!list) return {};
    if (!list->node->is_array()) refuse(*list, "must be a list of tables, each begun with [[" + list->name + "]]");
    std::vector<SceneValue> tables = elementsOf(*list);
    for (const SceneValue& each : tables) requireTable(each);
    return tables;
}

std::vector<std::pair<std::string, SceneValue>> membersOf(const SceneValue& table) {
    std::vector<std::pair<std::string, SceneValue>> members;
    for (auto&& [key, node] : *table.node->as_table()) members.emplace_back(key.str(), *find(table, key.str()));
    return members;
}

std::vector<SceneValue> elementsOf(const SceneValue& list) {
    if (!list.node->is_array()) refuse(list, "must be a list");
    const toml::array& nodes = *list.node->as_array();
    std::vector<SceneValue> elements;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        elements.push_back({list.file, &nodes[i], list.name + "[" + std::to_string(i) + "]"});
    return elements;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Names for enum values: one list next to each enum, for command line, files and panels.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

template <typename Value>
struct Name {
    const char* name;
    Value value;
};
template <typename Value>
Name(const char*, Value) -> Name<Value>;

inline constexpr std::array kSwitchNames = {Name{"on", true}, Name{"off", false}};

/// The value type of a list of Name.
template <typename List>
using NamedBy = decltype(List::value_type::value);

/// "" if the value has no name.
template <typename List>
constexpr const char* nameOf(const List& names, NamedBy<List> wanted) {
    for (const auto& [name, value] : names)
        if (value == wanted) return name;
    return "";
}

template <typename List>
std::vector<std::string_view> wordsOf(const List& names) {
    std::vector<std::string_view> words;
    for (const auto& each : names) words.emplace_back(each.name);
    return words;
}

template <typename List>
std::string joinedNames(const List& names, const char* separator) {
    std::string text;
    for (const auto& each : names) text += (text.empty() ? "" : separator) + std::string(each.name);
    return text;
}

/// The value with this name. Throws std::invalid_argument with the reason.
template <typename List>
NamedBy<List> parseName(const List& names, const std::string& text) {
    for (const auto& [name, value] : names)
        if (text == name) return value;
    throw std::invalid_argument("\"" + text + "\" is not one of " + joinedNames(names, ", "));
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Well-known text of coordinate systems, versions 1 and 2: KEYWORD["text", number, KEYWORD[...], ...], with brackets or
// parentheses. Contents of keywords are views of the text.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

namespace pointrt {

/// Calls use(keyword, content) for each child, until it returns true.
template <typename Use>
void forWktChildren(std::string_view inside, const Use& use) {
    const auto opens = [](char letter) { return letter == '[' || letter == '('; };
    const auto closes = [](char letter) { return letter == ']' || letter == ')'; };
    int depth = 0;
    bool quoted = false;
    std::size_t word = 0, open = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const char letter = inside[i];
        if (letter == '"') quoted = !quoted;
        if (quoted) continue;
        if (opens(letter) && depth++ == 0) open = i;
        if (letter == ',' && depth == 0) word = i + 1;
        if (!closes(letter) || --depth > 0) continue;
        if (depth < 0) return;
        std::string_view keyword = inside.substr(word, open - word);
        while (!keyword.empty() && std::string_view(" \t\r\n").find(keyword.front()) != std::string_view::npos)
            keyword.remove_prefix(1);
        if (use(keyword, inside.substr(open + 1, i - open - 1))) return;
    }
}

using WktWords = std::initializer_list<std::string_view>;

inline bool isOneOf(std::string_view keyword, WktWords words) {
    for (const std::string_view word : words)
        if (keyword == word) return true;
    return false;
}

/// The content of the first child with one of these keywords.
inline std::optional<std::string_view> wktChild(std::string_view inside, WktWords keywords) {
    std::optional<std::string_view> found;
    forWktChildren(inside, [&](std::string_view keyword, std::string_view content) {
        if (isOneOf(keyword, keywords)) found = content;
        return found.has_value();
    });
    return found;
}

} // namespace pointrt

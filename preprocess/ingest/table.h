// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a table: fields, comments and delimiters.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "preprocess/ingest/text.h"

namespace pointrt {

/// The fields of one line. The delimiter is a comma, a semicolon or, as ' ', any run of blanks.
struct Fields {
    std::string_view rest;
    char delimiter;

    bool next(std::string_view& field) {
        if (delimiter == ' ') {
            field = nextWord(rest);
            return !field.empty();
        }
        if (rest.empty()) return false;
        const std::size_t length = rest.find(delimiter);
        field = trim(rest.substr(0, length));
        rest.remove_prefix(length == std::string_view::npos ? rest.size() : length + 1);
        return true;
    }

    static std::string_view trim(std::string_view field) {
        const auto skipped = [](char letter) { return isBlank(letter) || letter == '"'; };
        while (!field.empty() && skipped(field.front())) field.remove_prefix(1);
        while (!field.empty() && skipped(field.back())) field.remove_suffix(1);
        return field;
    }
};

inline char delimiterOf(std::string_view line) {
    if (line.find(';') != std::string_view::npos) return ';';
    return line.find(',') != std::string_view::npos ? ',' : ' ';
}

inline std::string_view withoutBlanks(std::string_view line) {
    while (!line.empty() && isSpace(line.front())) line.remove_prefix(1);
    while (!line.empty() && isSpace(line.back())) line.remove_suffix(1);
    return line;
}

/// The text of a comment line; nullopt for other lines.
inline std::optional<std::string_view> commentText(std::string_view line) {
    if (line.starts_with("//")) return line.substr(2);
    if (line.starts_with("#")) return line.substr(1);
    return std::nullopt;
}

/// A hint for a line with decimal commas such as 1,5; "" for others.
inline std::string_view commaHint(std::string_view line) {
    int commas = 0;
    while (!line.empty()) {
        const std::size_t length = std::min(line.find_first_of(" \t;"), line.size());
        std::string word(Fields::trim(line.substr(0, length)));
        line.remove_prefix(std::min(length + 1, line.size()));
        const std::size_t comma = word.find(',');
        if (comma == std::string::npos || word.find('.') != std::string::npos) continue;
        word[comma] = '.';
        double value = 0;
        commas += wholeNumber(word, value) && word.back() != '.';
    }
    return commas > 1 ? " (decimal commas? write 1.5 for 1,5)" : "";
}

} // namespace pointrt

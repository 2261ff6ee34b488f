// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a table: records, fields, delimiters, comments and numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "preprocess/ingest/text.h"

namespace pointrt {

/// The fields of one record. The delimiter is a comma, a semicolon, a bar, a tab or, as ' ', any run of blanks. A field
/// in double quotes may contain delimiters (RFC 4180); doubled quotes in it stay doubled.
struct Fields {
    std::string_view rest;
    char delimiter;
    bool more = true; ///< the last character was a delimiter, so another field follows, perhaps an empty one

    bool next(std::string_view& field) { return delimiter == ' ' ? nextWordOrQuote(field) : nextDelimited(field); }

    /// Takes the next field if it is a number with a decimal point and nothing around it, which is the usual case.
    /// Otherwise returns false, and next() must be used.
    bool nextNumber(double& value) {
        if (delimiter == ' ') skipSpace(rest);
        const char* const end = rest.data() + rest.size();
        const char* const stop = parseNumber(rest.data(), end, value);
        if (!stop) return false;
        const bool is_last = stop == end;
        if (!is_last && (delimiter == ' ' ? !isSpace(*stop) : *stop != delimiter)) return false;
        if (is_last) more = false;
        const bool skips_delimiter = !is_last && delimiter != ' ';
        rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()) + skips_delimiter);
        return true;
    }

    static std::string_view trim(std::string_view field) {
        const auto skipped = [](char letter) { return isBlank(letter) || letter == '"'; };
        while (!field.empty() && skipped(field.front())) field.remove_prefix(1);
        while (!field.empty() && skipped(field.back())) field.remove_suffix(1);
        return field;
    }

private:
    bool nextWordOrQuote(std::string_view& field) {
        skipSpace(rest);
        if (rest.starts_with('"')) return nextQuote(field);
        field = nextWord(rest);
        return !field.empty();
    }
    bool nextQuote(std::string_view& field);
    bool nextDelimited(std::string_view& field);
};

/// Takes the next line from rest; if it ends within a quoted field, continues with the next lines, at most 16.
bool nextRecord(std::string_view& rest, std::string_view& record, char delimiter);

/// Semicolons outside quotes delimit fields, else two bars or more, else commas, else tabs, else blanks. Commas between
/// digits in words that are all numbers separate decimals or thousands, and tabs in a line that starts with one, or
/// repeats them, are blanks.
char delimiterOf(std::string_view line);

/// Whether a field marks a missing number: empty, NA, null and the like.
bool isMissingNumber(std::string_view field);

inline std::string_view withoutBlanks(std::string_view line) {
    skipSpace(line);
    while (!line.empty() && isSpace(line.back())) line.remove_suffix(1);
    return line;
}

/// The record without surrounding blanks; keeps tabs that delimit empty fields.
inline std::string_view trimmedRecord(std::string_view record, char delimiter) {
    if (delimiter != '\t') return withoutBlanks(record);
    return withoutBlanks(record).empty() ? std::string_view() : record;
}

/// The text of a comment line; nullopt for other lines, such as those that start with a spreadsheet's #N/A.
inline std::optional<std::string_view> commentText(std::string_view line) {
    if (line.starts_with("#N/A")) return std::nullopt;
    if (line.starts_with("//")) return line.substr(2);
    if (line.starts_with("#") || line.starts_with("%")) return line.substr(1); // MATLAB's is %
    return std::nullopt;
}

} // namespace pointrt

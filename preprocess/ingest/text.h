// SPDX-License-Identifier: GPL-3.0-or-later
// Parses numbers and words in a block of text, independent of the locale.
#pragma once

#include <cctype>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace pointrt {

inline bool isBlank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\v' || letter == '\f';
}
inline bool isSpace(char letter) { return isBlank(letter) || letter == '\n'; }

/// Whether a word has control characters, which messages cannot show; a 0 would end the name.
inline bool hasControls(std::string_view word) {
    for (const char letter : word)
        if (static_cast<unsigned char>(letter) < ' ' || letter == 127) return true;
    return false;
}

inline std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return lower;
}

/// from_chars leaves the value unset if it is out of range; strtod distinguishes 0 from infinity.
inline double outOfRangeValue(const char* begin, const char* end) {
    return std::strtod(std::string(begin, end).c_str(), nullptr);
}

/// Parses the number at the start of text and returns its end, or nullptr if text does not start with a number.
/// Accepts a leading +, inf, nan, -nan(ind) and the 1.#QNAN, 1.#INF, -1.#IND of old C runtimes (all as NaN).
inline const char* parseNumber(const char* at, const char* end, double& value) {
    if (at < end && *at == '+') {
        ++at;
        if (at < end && *at == '-') return nullptr;
    }
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error == std::errc::invalid_argument) return nullptr;
    if (error == std::errc::result_out_of_range) value = outOfRangeValue(at, stop);
    if (stop < end && *stop == '#') {
        value = std::numeric_limits<double>::quiet_NaN();
        const char* after = stop + 1;
        while (after < end && ((*after >= 'A' && *after <= 'Z') || (*after >= '0' && *after <= '9'))) ++after;
        return after;
    }
    return stop;
}

/// Whether the entire word is a number.
inline bool wholeNumber(std::string_view word, double& value) {
    const char* const end = word.data() + word.size();
    return parseNumber(word.data(), end, value) == end && !word.empty();
}

/// Whether the entire word is a decimal integer that fits.
template <typename Integer>
bool wholeInteger(std::string_view word, Integer& value) {
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && stop == end;
}

/// Takes the next line from rest, without its end (LF, CR LF). Returns false at the end of rest.
inline bool nextLine(std::string_view& rest, std::string_view& line) {
    if (rest.empty()) return false;
    const std::size_t length = rest.find('\n');
    line = rest.substr(0, length);
    rest.remove_prefix(length == std::string_view::npos ? rest.size() : length + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return true;
}

inline void skipSpace(std::string_view& rest) {
    while (!rest.empty() && isSpace(rest.front())) rest.remove_prefix(1);
}

/// Takes the next word from rest, skipping blanks before it. Empty at the end of rest.
inline std::string_view nextWord(std::string_view& rest) {
    skipSpace(rest);
    std::size_t length = 0;
    while (length < rest.size() && !isSpace(rest[length])) ++length;
    const std::string_view word = rest.substr(0, length);
    rest.remove_prefix(length);
    return word;
}

/// Iterates over lines that are not blank.
struct Lines {
    std::string_view rest;
    bool comments = false; ///< '#' starts a comment to the end of the line

    bool next(std::string_view& line) {
        while (nextLine(rest, line)) {
            if (comments) line = line.substr(0, line.find('#'));
            std::string_view words = line;
            if (!nextWord(words).empty()) return true;
        }
        return false;
    }
};

} // namespace pointrt

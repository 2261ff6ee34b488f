// SPDX-License-Identifier: Apache-2.0
// Words of the command line as values.
#pragma once

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// What a value is called on the command line.
template <typename Value>
using Names = std::vector<std::pair<const char*, Value>>;

extern const Names<Integrator> kIntegratorNames;
extern const Names<Room> kRoomNames;
extern const Names<bool> kSwitchNames; ///< on, off
extern const Names<DenoiseChoice> kDenoiseNames;

/// "" where it has none.
template <typename Value>
const char* nameOf(const Names<Value>& names, Value wanted) {
    for (const auto& [name, value] : names)
        if (value == wanted) return name;
    return "";
}

/// The parsers take all of text. They throw std::invalid_argument with the reason.
template <typename Value>
Value parseName(const Names<Value>& names, const std::string& text) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (text == name) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw std::invalid_argument("\"" + text + "\" is none of " + known);
}

/// All of text as a number; false where it is not one or out of T's range.
template <typename T>
bool parseNumber(const std::string& text, T& value) {
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end;
}

/// A whole number from low to high.
std::uint32_t parseCount(const std::string& text, std::uint32_t low, std::uint32_t high);

/// A number from low to high.
double parseReal(const std::string& text, double low, double high);

/// A number above low and up to high.
double parseRealAbove(const std::string& text, double low, double high);

/// "WxH", each from 1 to most.
std::pair<std::uint32_t, std::uint32_t> parseSize(const std::string& text, std::uint32_t most);

/// Degrees above 0 and below 180.
double parseAngle(const std::string& text);

/// "X,Y,Z" as three finite numbers.
Vec3 parseVector(const std::string& text);

} // namespace pointrt

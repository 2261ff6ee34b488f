// SPDX-License-Identifier: Apache-2.0
// Values of a scene file that know their name and line. Every function that takes one throws Error kBadInput
// "FILE:LINE: key "NAME": reason" where the value is not what it asks for.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/scene/scene_description.h"
#include "runtime/scene_io/toml_defined.h"
#include "runtime/util/names.h"

namespace pointrt {

struct SceneValue {
    const std::string* file; ///< for messages
    const toml::node* node;  ///< never null
    std::string name;        ///< "light[2].radius"; "" for the whole file
};

/// What a number may be, ends included.
struct Range {
    double low, high;
};

// Squares and products of a few such numbers stay within float.
constexpr double kLargest = 1e12;
constexpr double kSmallest = 1e-9;
constexpr Range kCoordinates{-kLargest, kLargest};
constexpr Range kLengths{kSmallest, kLargest};
constexpr Range kLight{0, kLargest};
constexpr Range kShare{0, 1};
/// What scans say of points: any finite number.
constexpr Range kNumbers{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// "FILE:LINE: key "NAME": "
std::string placeOf(const SceneValue& value);
[[noreturn]] void refuse(const SceneValue& value, const std::string& reason);
/// "a, b, c"
std::string joined(const std::vector<std::string_view>& words);
/// ", did you mean "NAME"?" for the name nearest to text; "" where none is near.
std::string suggestion(std::string_view text, const std::vector<std::string_view>& names);

/// The whole of text as a table. Throws Error kBadInput "FILE:LINE: reason" where it is no TOML.
toml::table parseToml(std::string_view text, const std::string& file);

std::optional<SceneValue> find(const SceneValue& table, std::string_view key);
SceneValue require(const SceneValue& table, std::string_view key);
/// Which of two keys is there; both or none is refused.
bool hasFirst(const SceneValue& table, std::string_view first, std::string_view second);
/// owner: what has these keys, for the message, such as "a metal".
void requireKnownKeys(const SceneValue& table, const std::string& owner, const std::vector<std::string_view>& known);

/// Refuses the first of keys that is there.
void forbid(const SceneValue& table, std::initializer_list<std::string_view> keys, const std::string& reason);

/// A table under key, where there is one.
std::optional<SceneValue> findTable(const SceneValue& table, std::string_view key);
/// The tables of a list under key; none where it is missing.
std::vector<SceneValue> findTables(const SceneValue& table, std::string_view key);
/// The members of a table.
std::vector<std::pair<std::string, SceneValue>> membersOf(const SceneValue& table);
void requireTable(const SceneValue& value);
/// What a list has.
std::vector<SceneValue> elementsOf(const SceneValue& list);

double numberOf(const SceneValue& value, Range range);
std::uint32_t wholeNumberOf(const SceneValue& value, std::uint32_t low, std::uint32_t high);
bool flagOf(const SceneValue& value);
/// Not empty, without control characters.
std::string textOf(const SceneValue& value);
Vec3 vectorOf(const SceneValue& value, Range range = kCoordinates);
/// True where a and b, about 1 or less, are the same but for the rounding of a few operations. What a program has made
/// unit length or a right angle is kept to the bit, so that a scene that is written and read again is the same.
constexpr bool isNear(double a, double b) { return a - b < 1e-14 && b - a < 1e-14; }

/// [low, high] with low below high.
ValueRange rangeOf(const SceneValue& value);

/// A vector made one long; zero is refused.
Vec3 directionOf(const SceneValue& value);
/// [r, g, b] within range, linear, or "#rrggbb", sRGB.
Color colorOf(const SceneValue& value, Range range = kShare);
/// "#rrggbb"
std::array<std::uint8_t, 3> bytesOf(const SceneValue& value);
/// Position of the text among names.
std::size_t choiceOf(const SceneValue& value, const std::vector<std::string_view>& names);
/// What the text names in a list of Name (runtime/util/names.h).
template <typename List>
NamedBy<List> nameChoiceOf(const SceneValue& value, const List& names) {
    return names[choiceOf(value, wordsOf(names))].value;
}

/// These set what is there and leave the default where it is not.
template <typename Number>
void takeNumber(const SceneValue& table, std::string_view key, Range range, Number& number) {
    if (const auto value = find(table, key)) number = static_cast<Number>(numberOf(*value, range));
}
void takeFlag(const SceneValue& table, std::string_view key, bool& flag);
void takeColor(const SceneValue& table, std::string_view key, Range range, Color& color);

} // namespace pointrt

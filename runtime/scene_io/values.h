// SPDX-License-Identifier: Apache-2.0
// Values of a scene file with their name and line. Functions that take one throw Error kBadInput
// "FILE:LINE: key "NAME": reason" if the value is not of the requested type or range.
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

/// The range of a number, inclusive.
struct Range {
    double low, high;
};

// Squares and products of a few such numbers fit in float.
constexpr double kLargest = 1e12;
constexpr double kSmallest = 1e-9;
constexpr Range kCoordinates{-kLargest, kLargest};
constexpr Range kLengths{kSmallest, kLargest};
constexpr Range kLightValues{0, kLargest};
constexpr Range kShares{0, 1};
/// The values of attributes: any finite number.
constexpr Range kNumbers{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// "FILE:LINE: key "NAME": "
std::string placeOf(const SceneValue& value);
[[noreturn]] void refuse(const SceneValue& value, const std::string& reason);
/// "a, b, c"
std::string joined(const std::vector<std::string_view>& words);
/// ", did you mean "NAME"?" for the name nearest to text; "" if none is near.
std::string suggestion(std::string_view text, const std::vector<std::string_view>& names);

/// Parses text. Throws Error kBadInput "FILE:LINE: reason" for invalid TOML.
toml::table parseToml(std::string_view text, const std::string& file);

std::optional<SceneValue> find(const SceneValue& table, std::string_view key);
SceneValue require(const SceneValue& table, std::string_view key);
/// True if the first of two keys is present; refuses both and neither.
bool hasFirst(const SceneValue& table, std::string_view first, std::string_view second);
/// Refuses keys other than known. owner: what the keys belong to, for the message, such as "a metal".
void requireKnownKeys(const SceneValue& table, const std::string& owner, const std::vector<std::string_view>& known);

/// Refuses the first of keys that is present.
void forbid(const SceneValue& table, std::initializer_list<std::string_view> keys, const std::string& reason);

/// The table under key, if any.
std::optional<SceneValue> findTable(const SceneValue& table, std::string_view key);
/// The tables of a list under key; empty if the key is missing.
std::vector<SceneValue> findTables(const SceneValue& table, std::string_view key);
/// The members of a table.
std::vector<std::pair<std::string, SceneValue>> membersOf(const SceneValue& table);
void requireTable(const SceneValue& value);
/// The elements of a list; refuses other values.
std::vector<SceneValue> elementsOf(const SceneValue& list);

double numberOf(const SceneValue& value, Range range);
std::uint32_t wholeNumberOf(const SceneValue& value, std::uint32_t low, std::uint32_t high);
bool flagOf(const SceneValue& value);
/// A string, not empty and without control characters.
std::string textOf(const SceneValue& value);
Vec3 vectorOf(const SceneValue& value, Range range = kCoordinates);
/// True if a and b, about 1 or less, differ only by the rounding of a few operations. Vectors that are already
/// normalised or perpendicular are kept bit-identical, so that a scene survives writing and reading.
constexpr bool isNear(double a, double b) { return a - b < 1e-14 && b - a < 1e-14; }

/// [low, high] with low below high.
ValueRange rangeOf(const SceneValue& value);

/// A normalised vector; refuses zero.
Vec3 directionOf(const SceneValue& value);
/// [r, g, b] within range, linear, or "#rrggbb", sRGB.
Color colorOf(const SceneValue& value, Range range = kShares);
/// "#rrggbb"
std::array<std::uint8_t, 3> bytesOf(const SceneValue& value);
/// The index of the text in names.
std::size_t choiceOf(const SceneValue& value, const std::vector<std::string_view>& names);
/// The value of the text in a list of Name (runtime/util/names.h).
template <typename List>
NamedBy<List> nameChoiceOf(const SceneValue& value, const List& names) {
    return names[choiceOf(value, wordsOf(names))].value;
}

/// The take functions set the variable if the key is present.
template <typename Number>
void takeNumber(const SceneValue& table, std::string_view key, Range range, Number& number) {
    if (const auto value = find(table, key)) number = static_cast<Number>(numberOf(*value, range));
}
void takeFlag(const SceneValue& table, std::string_view key, bool& flag);
void takeColor(const SceneValue& table, std::string_view key, Range range, Color& color);

} // namespace pointrt

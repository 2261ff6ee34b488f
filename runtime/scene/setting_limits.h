// SPDX-License-Identifier: Apache-2.0
// The ranges of settings, a struct for each type of value, and the conversions of ranges and values from and to text.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/scene/background.h"
#include "runtime/scene/value_range.h"
#include "runtime/util/names.h"
#include "runtime/util/parse.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

struct CountRange {
    using Value = std::uint32_t;
    std::uint32_t low, high;
};

struct RealRange {
    using Value = float;
    double low, high;
};

/// Width and height, 1 to longest each.
struct SizeRange {
    using Value = PixelSize;
    std::uint32_t longest;
};

/// A word for --color-by. Whether it names an attribute depends on the scans.
struct AttributeWord {
    using Value = std::string;
};

/// Two numbers, the lower first.
struct RangeOfValues {
    using Value = ValueRange;
};

/// A plain colour behind the scene.
struct BackgroundWord {
    using Value = Background;
};

/// A choice of names. kSwitchNames makes a switch, which is a boolean in scene files.
template <typename Named>
struct OneOf {
    using Value = Named;
    std::span<const Name<Named>> names;
};
template <typename Named, std::size_t kCount>
OneOf(const std::array<Name<Named>, kCount>&) -> OneOf<Named>;

/// "LOW to HIGH", or the names.
std::string limitsText(CountRange range);
std::string limitsText(RealRange range);
std::string limitsText(SizeRange range);
std::string limitsText(AttributeWord);
std::string limitsText(RangeOfValues);
std::string limitsText(BackgroundWord);
template <typename Named>
std::string limitsText(OneOf<Named> choices) {
    return joinedNames(choices.names, ", ");
}

/// value in the syntax of the command line.
std::string valueText(CountRange, std::uint32_t value);
std::string valueText(RealRange, float value);
std::string valueText(SizeRange, PixelSize value);
std::string valueText(AttributeWord, const std::string& value);
std::string valueText(RangeOfValues, ValueRange value);
std::string valueText(BackgroundWord, const Background& value);
template <typename Named>
std::string valueText(OneOf<Named> choices, Named value) {
    return nameOf(choices.names, value);
}

/// The value of text. Throws std::invalid_argument with the reason if it is malformed or out of range.
std::uint32_t parseValue(CountRange range, const std::string& text);
float parseValue(RealRange range, const std::string& text);
PixelSize parseValue(SizeRange range, const std::string& text);
std::string parseValue(AttributeWord, const std::string& text);
ValueRange parseValue(RangeOfValues, const std::string& text);
Background parseValue(BackgroundWord, const std::string& text);
template <typename Named>
Named parseValue(OneOf<Named> choices, const std::string& text) {
    return parseName(choices.names, text);
}

} // namespace pointrt

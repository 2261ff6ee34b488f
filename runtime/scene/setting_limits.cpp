// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/setting_limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "format/base/printable.h"

namespace pointrt {
namespace {

/// The shortest text that parses to the same number.
std::string exactText(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace

std::string limitsText(CountRange range) { return std::to_string(range.low) + " to " + std::to_string(range.high); }
std::string limitsText(RealRange range) { return plainText(range.low) + " to " + plainText(range.high); }
std::string limitsText(SizeRange range) { return "1 to " + std::to_string(range.longest); }
std::string limitsText(AttributeWord) { return "rgb, height, normal, scan, intensity, class or any attribute's name"; }
std::string limitsText(RangeOfValues) { return "the lower first"; }
std::string limitsText(BackgroundWord) { return "black, white, transparent or #RRGGBB"; }

std::string valueText(CountRange, std::uint32_t value) { return std::to_string(value); }
std::string valueText(RealRange, float value) { return plainText(value); }
std::string valueText(SizeRange, PixelSize value) {
    return std::to_string(value.width) + "x" + std::to_string(value.height);
}
std::string valueText(AttributeWord, const std::string& value) { return value; }
std::string valueText(RangeOfValues, ValueRange value) { return exactText(value.low) + "," + exactText(value.high); }
std::string valueText(BackgroundWord, const Background& value) { return backgroundName(value); }

std::uint32_t parseValue(CountRange range, const std::string& text) { return parseCount(text, range.low, range.high); }
float parseValue(RealRange range, const std::string& text) {
    return static_cast<float>(parseReal(text, range.low, range.high));
}
PixelSize parseValue(SizeRange range, const std::string& text) { return parseSize(text, range.longest); }

std::string parseValue(AttributeWord, const std::string& text) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (text.empty() || std::any_of(text.begin(), text.end(), is_control))
        throw std::invalid_argument("\"" + printable(text) + "\" is not a valid attribute name");
    return text;
}

ValueRange parseValue(RangeOfValues, const std::string& text) {
    const std::size_t comma = text.find(',');
    ValueRange range;
    if (comma != std::string::npos && parseNumber(text.substr(0, comma), range.low) &&
        parseNumber(text.substr(comma + 1), range.high) && std::isfinite(range.low) && std::isfinite(range.high) &&
        range.low < range.high)
        return range;
    throw std::invalid_argument("\"" + text + "\" is not LO,HI with two finite numbers, the lower first");
}

Background parseValue(BackgroundWord, const std::string& text) {
    if (const auto background = backgroundNamed(text)) return *background;
    throw std::invalid_argument("\"" + printable(text) +
                                "\" is not black, white, transparent or a colour such as #ff8000");
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "format/base/printable.h"
#include "runtime/scene_io/values.h"
#include "runtime/util/color.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

std::string numberText(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

std::string rangeText(double low, double high) { return "from " + numberText(low) + " to " + numberText(high); }

std::vector<double> numbersOf(const SceneValue& list, std::size_t count, Range range) {
    if (!list.node->is_array() || list.node->as_array()->size() != count)
        refuse(list, "must be a list of " + std::to_string(count) + " numbers");
    std::vector<double> numbers;
    for (const SceneValue& each : elementsOf(list)) numbers.push_back(numberOf(each, range));
    return numbers;
}

} // namespace

double numberOf(const SceneValue& value, Range range) {
    if (!value.node->is_number()) refuse(value, "must be a number");
    // value<double>() returns none for integers that a double cannot represent
    const auto* whole = value.node->as_integer();
    const double number = whole ? static_cast<double>(whole->get()) : value.node->as_floating_point()->get();
    if (number >= range.low && number <= range.high) return number;
    refuse(value, "is " + numberText(number) + ", but must be " + rangeText(range.low, range.high));
}

std::uint32_t wholeNumberOf(const SceneValue& value, std::uint32_t low, std::uint32_t high) {
    const auto* number = value.node->as_integer();
    if (number && number->get() >= low && number->get() <= high) return static_cast<std::uint32_t>(number->get());
    refuse(value, "must be an integer " + rangeText(low, high));
}

bool flagOf(const SceneValue& value) {
    if (!value.node->is_boolean()) refuse(value, "must be true or false");
    return value.node->as_boolean()->get();
}

std::string textOf(const SceneValue& value) {
    if (!value.node->is_string()) refuse(value, "must be a string in quotes");
    const std::string& text = value.node->as_string()->get();
    if (text.empty()) refuse(value, "must not be empty");
    for (char c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) refuse(value, "must not have control characters");
    return text;
}

Vec3 vectorOf(const SceneValue& value, Range range) {
    const std::vector<double> numbers = numbersOf(value, 3, range);
    return {numbers[0], numbers[1], numbers[2]};
}

ValueRange rangeOf(const SceneValue& value) {
    const std::vector<double> ends = numbersOf(value, 2, kNumbers);
    if (!(ends[0] < ends[1])) refuse(value, "must be two numbers, the lower first");
    return {ends[0], ends[1]};
}

Vec3 directionOf(const SceneValue& value) {
    const Vec3 vector = vectorOf(value);
    const double size = length(vector);
    if (size < kSmallest) refuse(value, "a vector of length zero has no direction");
    return isNear(size, 1) ? vector : vector * (1 / size);
}

std::array<std::uint8_t, 3> bytesOf(const SceneValue& value) {
    const std::string text = textOf(value);
    std::array<std::uint8_t, 3> bytes{};
    if (!parseHexColor(text, bytes)) refuse(value, "\"" + printable(text) + "\" is not a colour such as \"#ff8000\"");
    return bytes;
}

Color colorOf(const SceneValue& value, Range range) {
    if (value.node->is_string()) {
        const auto bytes = bytesOf(value);
        return {linearFromSrgb(bytes[0]), linearFromSrgb(bytes[1]), linearFromSrgb(bytes[2])};
    }
    if (!value.node->is_array()) refuse(value, "must be a colour: [red, green, blue] or \"#rrggbb\"");
    const std::vector<double> numbers = numbersOf(value, 3, range);
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

std::size_t choiceOf(const SceneValue& value, const std::vector<std::string_view>& names) {
    const std::string text = textOf(value);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    refuse(value, "\"" + printable(text) + "\" is not one of " + joined(names));
}

void takeFlag(const SceneValue& table, std::string_view key, bool& flag) {
    if (const auto value = find(table, key)) flag = flagOf(*value);
}

void takeColor(const SceneValue& table, std::string_view key, Range range, Color& color) {
    if (const auto value = find(table, key)) color = colorOf(*value, range);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cmath>

#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

template <typename Number>
std::string shortest(Number number) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

double valueOf(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

} // namespace

void begin(SceneWriting& writing, const std::string& header) { writing.text += "\n" + header + "\n"; }

void put(SceneWriting& writing, const char* key, const std::string& value) {
    writing.text += std::string(key) + " = " + value + "\n";
}

std::string listOf(std::initializer_list<std::string> values) {
    std::string text;
    for (const std::string& value : values) {
        text += text.empty() ? "[" : ", ";
        text += value;
    }
    return text += "]";
}

std::string tomlOf(double number) {
    std::string text = shortest(number);
    // without a decimal point, the text would be a TOML integer, which has no -0 and is limited to 2^63
    constexpr double most_digits = 1e15;
    const bool whole = text.find_first_of(".ein") == std::string::npos;
    if (whole && (std::abs(number) > most_digits || (number == 0 && std::signbit(number)))) text += ".0";
    return text;
}

std::string tomlOf(float number) {
    const std::string text = shortest(number);
    // the reader parses a double and rounds it to float: if that gives another float, write all digits
    const bool same = static_cast<float>(valueOf(text)) == number;
    return same && text.find_first_of(".ein") != std::string::npos ? text : tomlOf(static_cast<double>(number));
}

std::string tomlOf(std::uint32_t number) { return std::to_string(number); }

std::string tomlOf(bool flag) { return flag ? "true" : "false"; }

std::string tomlOf(Vec3 vector) { return listOf({tomlOf(vector.x), tomlOf(vector.y), tomlOf(vector.z)}); }

std::string tomlOf(const Color& color) { return listOf({tomlOf(color[0]), tomlOf(color[1]), tomlOf(color[2])}); }

std::string tomlOf(const std::array<Vec3, 3>& rows) {
    return listOf({tomlOf(rows[0]), tomlOf(rows[1]), tomlOf(rows[2])});
}

std::string tomlOf(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        constexpr char digits[] = "0123456789abcdef";
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            quoted += {'\\', c};
        else if (byte < 0x20 || byte == 0x7F)
            quoted += {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 15]};
        else
            quoted += c;
    }
    return quoted + "\"";
}

} // namespace pointrt

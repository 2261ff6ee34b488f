// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/parse.h"

#include <cmath>
#include <cstdio>
#include <string_view>

#include "format/base/printable.h"

namespace pointrt {
namespace {

std::string shown(const std::string& text) { return "\"" + printable(text) + "\""; }

/// Finite numbers separated by commas. False if there are not N of them.
template <std::size_t N>
bool parseNumbers(const std::string& text, std::array<double, N>& values) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const std::size_t comma = text.find(',', start);
        const bool last = comma == std::string::npos;
        if (last != (i + 1 == N) || !parseNumber(text.substr(start, comma - start), values[i]) ||
            !std::isfinite(values[i]))
            return false;
        start = comma + 1;
    }
    return true;
}

} // namespace

std::string plainText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::uint32_t parseCount(const std::string& text, std::uint32_t low, std::uint32_t high) {
    std::uint32_t value = 0;
    if (parseNumber(text, value) && value >= low && value <= high) return value;
    throw std::invalid_argument(shown(text) + " is not a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high));
}

double parseReal(const std::string& text, double low, double high) {
    double value = 0;
    if (parseNumber(text, value) && value >= low && value <= high) return value;
    throw std::invalid_argument(shown(text) + " is not a number from " + plainText(low) + " to " + plainText(high));
}

double parseRealAbove(const std::string& text, double low, double high) {
    double value = 0;
    if (parseNumber(text, value) && value > low && value <= high) return value;
    throw std::invalid_argument(shown(text) + " is not a number above " + plainText(low) + " and up to " +
                                plainText(high));
}

std::uint64_t parseBytes(const std::string& text) {
    constexpr std::string_view kUnits = "KMGT";
    constexpr double kMost = 9e18; // below 2^63
    const std::size_t unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
    const bool has_unit = unit != std::string_view::npos;
    double number = 0;
    if (parseNumber(has_unit ? text.substr(0, text.size() - 1) : text, number)) {
        const double bytes = has_unit ? std::ldexp(number, 10 * (static_cast<int>(unit) + 1)) : number;
        if (bytes >= 1 && bytes <= kMost) return static_cast<std::uint64_t>(bytes);
    }
    throw std::invalid_argument(shown(text) + " is not a size such as 2G, 500M or a number of bytes");
}

PixelSize parseSize(const std::string& text, std::uint32_t most) {
    const std::size_t cross = text.find('x');
    const auto isSide = [most](std::uint32_t side) { return side >= 1 && side <= most; };
    PixelSize size;
    if (cross != std::string::npos && parseNumber(text.substr(0, cross), size.width) &&
        parseNumber(text.substr(cross + 1), size.height) && isSide(size.width) && isSide(size.height))
        return size;
    throw std::invalid_argument(shown(text) + " is not WxH with 1 to " + std::to_string(most) + " pixels each");
}

double parseAngle(const std::string& text) {
    double value = 0;
    if (parseNumber(text, value) && value > 0 && value < 180) return value;
    throw std::invalid_argument(shown(text) + " is not an angle above 0 and below 180 degrees");
}

Vec3 parseVector(const std::string& text) {
    std::array<double, 3> values{};
    if (!parseNumbers(text, values))
        throw std::invalid_argument(shown(text) + " is not X,Y,Z with three finite numbers");
    return {values[0], values[1], values[2]};
}

std::array<double, 6> parseBox(const std::string& text) {
    std::array<double, 6> box{};
    if (!parseNumbers(text, box))
        throw std::invalid_argument(shown(text) + " is not MINX,MINY,MINZ,MAXX,MAXY,MAXZ with six finite numbers");
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(box[axis] < box[axis + 3]))
            throw std::invalid_argument("in " + shown(text) + " the minimum of " + "xyz"[axis] +
                                        " is not below its maximum");
    return box;
}

bool parseHexColor(std::string_view text, std::array<std::uint8_t, 3>& color) {
    if (text.size() != 7 || text[0] != '#') return false;
    for (std::size_t i = 0; i < color.size(); ++i) {
        const char* digits = text.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(digits, digits + 2, color[i], 16);
        if (error != std::errc() || end != digits + 2) return false;
    }
    return true;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Parses words of the command line or of a recording. Each function parses all of text and throws std::invalid_argument
// with the reason if it is invalid.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "runtime/util/pixel_size.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// Parses all of text as a number. Returns false, without an exception, if it is not a number or out of T's range.
template <typename T>
bool parseNumber(const std::string& text, T& value) {
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end;
}

/// An integer from low to high.
std::uint32_t parseCount(const std::string& text, std::uint32_t low, std::uint32_t high);

/// A number from low to high.
double parseReal(const std::string& text, double low, double high);

/// A number above low and up to high.
double parseRealAbove(const std::string& text, double low, double high);

/// "500M": bytes, or kibi-, mebi-, gibi- or tebibytes with K, M, G or T, above 0 and below 2^63.
std::uint64_t parseBytes(const std::string& text);

/// "WxH", each from 1 to most.
PixelSize parseSize(const std::string& text, std::uint32_t most);

/// Degrees above 0 and below 180.
double parseAngle(const std::string& text);

/// "X,Y,Z" as three finite numbers.
Vec3 parseVector(const std::string& text);

/// "MINX,MINY,MINZ,MAXX,MAXY,MAXZ" as six numbers, each minimum below its maximum.
std::array<double, 6> parseBox(const std::string& text);

/// "#RRGGBB", with hexadecimal digits of either case. Returns false, without an exception, for other text.
bool parseHexColor(std::string_view text, std::array<std::uint8_t, 3>& color);

/// A number with up to six significant digits, for messages.
std::string plainText(double value);

} // namespace pointrt

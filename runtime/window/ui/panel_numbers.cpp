// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pointrt {
namespace {

std::string formatted(const char* format, int decimals, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, decimals, value);
    return text;
}

} // namespace

int decimalsFor(double size) {
    if (!(size > 0) || !std::isfinite(size)) return 3;
    return static_cast<int>(std::clamp(std::ceil(4 - std::log10(size)), 0.0, 9.0));
}

std::string lengthText(double value, double size) {
    constexpr double widest = 1e12; // for larger numbers, an exponent is clearer than digits
    if (!(std::abs(value) < widest)) return formatted("%.*g", 4, value);
    return formatted("%.*f", decimalsFor(size), value);
}

std::string pointText(Vec3 point, double size) {
    return lengthText(point.x, size) + "  " + lengthText(point.y, size) + "  " + lengthText(point.z, size);
}

std::string countText(std::uint64_t count) {
    const std::string digits = std::to_string(count);
    std::string text;
    for (std::size_t d = 0; d < digits.size(); ++d) {
        if (d > 0 && (digits.size() - d) % 3 == 0) text += ' ';
        text += digits[d];
    }
    return text;
}

std::string bytesText(std::uint64_t bytes) {
    constexpr const char* units[] = {"kB", "MB", "GB", "TB", "PB", "EB"};
    if (bytes < 1000) return std::to_string(bytes) + " B";
    double value = static_cast<double>(bytes) / 1000;
    std::size_t unit = 0;
    for (; value >= 1000; value /= 1000) ++unit;
    return formatted("%.*f ", value < 10 ? 1 : 0, value) + units[unit];
}

} // namespace pointrt

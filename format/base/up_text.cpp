// SPDX-License-Identifier: Apache-2.0
#include "format/base/up_text.h"

#include <cstdio>

#include "format/base/axis_name.h"

namespace pointrt {
namespace {

std::string directionText(const std::array<double, 3>& up) {
    const std::string name = nameOfDirection(up);
    if (!name.empty()) return name;
    char text[80];
    std::snprintf(text, sizeof text, "%.2f,%.2f,%.2f", up[0], up[1], up[2]);
    return text;
}

} // namespace

std::string upText(const std::array<double, 3>& up, std::string_view from, std::string_view reason) {
    const std::string direction = directionText(up), why(reason);
    const char* const change = " (change it with --up)";
    if (from == "data") return "up is " + direction + ", from the scan's " + why + change;
    if (from == "format") return "up is " + direction + ", " + why + change;
    if (from == "guess") return "up is a guess: " + direction + ", " + why + change;
    return {};
}

} // namespace pointrt

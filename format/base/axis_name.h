// SPDX-License-Identifier: Apache-2.0
// Names of the axis directions in --up, scene files and reports.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pointrt {

struct NamedAxis {
    const char* name;
    std::array<double, 3> direction; ///< unit length
};
inline constexpr std::array<NamedAxis, 6> kNamedAxes = {
    {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}, {"-x", {-1, 0, 0}}, {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}}};

/// Nothing for other names.
inline std::optional<std::array<double, 3>> directionNamed(std::string_view word) {
    for (const NamedAxis& axis : kNamedAxes)
        if (word == axis.name) return axis.direction;
    return std::nullopt;
}

/// "" for directions without a name.
inline const char* nameOfDirection(const std::array<double, 3>& direction) {
    for (const NamedAxis& axis : kNamedAxes)
        if (direction == axis.direction) return axis.name;
    return "";
}

} // namespace pointrt

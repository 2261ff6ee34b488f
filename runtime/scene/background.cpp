// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/background.h"

#include <cstdio>

#include "runtime/util/names.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr std::array kBackgroundNames = {Name{"black", Background{{0, 0, 0}, false}},
                                         Name{"white", Background{{255, 255, 255}, false}},
                                         Name{"transparent", Background{{0, 0, 0}, true}}};

} // namespace

std::optional<Background> backgroundNamed(std::string_view word) {
    for (const auto& [name, background] : kBackgroundNames)
        if (word == name) return background;
    Background background;
    if (parseHexColor(word, background.color)) return background;
    return std::nullopt;
}

std::string backgroundName(const Background& background) {
    const std::string name = nameOf(kBackgroundNames, background);
    if (!name.empty()) return name;
    char digits[8];
    std::snprintf(digits, sizeof digits, "#%02x%02x%02x", background.color[0], background.color[1],
                  background.color[2]);
    return digits;
}

Color backgroundRadiance(const Background& background) {
    const auto& [red, green, blue] = background.color;
    return {linearFromSrgb(red), linearFromSrgb(green), linearFromSrgb(blue)};
}

} // namespace pointrt

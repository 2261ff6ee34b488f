// SPDX-License-Identifier: Apache-2.0
// A plain background of a picture, and the words for it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/util/color.h"

namespace pointrt {

/// A colour in every direction, in place of the sky.
struct Background {
    std::array<std::uint8_t, 3> color{}; ///< sRGB; default black
    /// The picture has no background: color is black, and PNGs store the scene's coverage as alpha.
    bool transparent = false;
    bool operator==(const Background&) const = default;
};

/// The background that a word names: black, white, transparent or #RRGGBB. None for other words.
std::optional<Background> backgroundNamed(std::string_view word);
/// The word that backgroundNamed reads.
std::string backgroundName(const Background& background);

/// The background's radiance: the exact inverse of the sRGB transfer function, so that PNGs show exactly its colour.
Color backgroundRadiance(const Background& background);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Paints splats: replaces the colours and material rows of their file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "runtime/device_scene/splat_numbers.h"
#include "runtime/scene/color_map.h"

namespace pointrt {

/// Colours by a number. A scan without it gets the colour for missing numbers.
struct NumberColors {
    std::optional<SplatNumbers> numbers;
    ColorScale scale;
};

/// Red, green and blue from x, y and z of the normal, 0 at -1 and 255 at 1.
struct NormalColors {
    std::array<Vec3, 3> rotation; ///< of the placement
};

/// Selects splats and assigns a material row to them.
struct SplatOverride {
    struct OfRow {
        std::uint8_t row;
    };
    struct OfColors {
        Srgb8 low, high;
    };
    struct OfNumbers {
        SplatNumbers numbers;
        std::vector<ValueRange> ranges;
    };
    std::variant<OfRow, OfColors, OfNumbers> splats;
    std::uint8_t row = 0; ///< to assign; unused for OfRow, whose material replaces that of the file's row
};

/// How to paint the splats of an instance.
struct SplatPaint {
    std::variant<std::monostate, NumberColors, NormalColors> colors;
    std::vector<SplatOverride> overrides;             ///< later ones win
    std::vector<SplatOverride::OfNumbers> selections; ///< of filters: splats that match all of them are shown
    float size = 1;                                   ///< factor for the radii
};

/// Fills painted with the words of consecutive splats from number first on, on all cores. Splats that the selections
/// hide are painted, too: splat_selection.h removes them.
void paintSplats(const SplatPaint& paint, const std::uint32_t* file_words, std::size_t first,
                 std::span<std::uint32_t> painted);

} // namespace pointrt

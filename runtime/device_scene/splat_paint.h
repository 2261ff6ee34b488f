// SPDX-License-Identifier: Apache-2.0
// Splats in other colours, and of other materials, than their file has them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "runtime/device_scene/splat_numbers.h"
#include "runtime/scene/color_map.h"

namespace pointrt {

/// By a number; where a scan has none, all of it is missing.
struct NumberColors {
    std::optional<SplatNumbers> numbers;
    ColorScale scale;
};

/// Red, green and blue for x, y and z of the normal, black at -1 and full at 1; rotation: of the placement.
struct NormalColors {
    std::array<Vec3, 3> rotation;
};

/// Splats that go to another material, or back to the file's own row.
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
    std::uint8_t row = 0; ///< that they get; of OfRow none: it stands in the place of the file's row
};

/// What is new about the splats of an instance.
struct SplatPaint {
    std::variant<std::monostate, NumberColors, NormalColors> colors;
    std::vector<SplatOverride> overrides; ///< later ones win
};

/// The painted words of splats first to first + painted.size() / PRO_SPLAT_WORDS of file, on all cores.
void paintSplats(const SplatPaint& paint, const std::uint32_t* file_words, std::size_t first,
                 std::span<std::uint32_t> painted);

} // namespace pointrt

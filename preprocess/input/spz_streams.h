// SPDX-License-Identifier: GPL-3.0-or-later
// The container of SPZ files: header, and an array for each thing that Gaussians have.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "preprocess/input/source.h"

namespace pointrt {

/// In the order of the file. Harmonics beyond the constant one follow them.
enum SpzArray { kSpzPositions, kSpzAlphas, kSpzColors, kSpzScales, kSpzRotations, kSpzArrayCount };

struct SpzFile {
    std::uint32_t version = 0;
    std::uint64_t count = 0;
    int harmonics_degree = 0;
    int fractional_bits = 0; ///< of a fixed-point coordinate
    std::array<std::string_view, kSpzArrayCount> arrays;
    std::array<std::string, kSpzArrayCount> unpacked; ///< what they point to, where the file has them packed

    std::size_t bytesEach(SpzArray array) const;
};

/// Takes a file (of versions 1 to 3: with its gzip gone already) apart into arrays of count times bytesEach. Throws
/// Error when it is broken, cut short or of another version, and before memory is taken for more than it can hold.
SpzFile openSpz(const Source& source);

} // namespace pointrt

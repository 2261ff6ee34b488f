// SPDX-License-Identifier: GPL-3.0-or-later
// The container of SPZ files: a header, and an array for each parameter of the Gaussians.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// The arrays in the order of the file.
enum SpzArray {
    kSpzPositions,
    kSpzAlphas,
    kSpzColors,
    kSpzScales,
    kSpzRotations,
    kSpzHarmonics, ///< of degree 1 and above; without a stream if the degree is 0
    kSpzArrayCount
};

struct SpzFile {
    std::uint32_t version = 0;
    std::uint64_t count = 0;
    int harmonics_degree = 0; ///< 0 to 4
    int fractional_bits = 0;  ///< of a fixed-point coordinate
    std::array<std::string_view, kSpzArrayCount> arrays;
    std::array<std::string, kSpzArrayCount> unpacked; ///< storage of the arrays, if the file has them compressed

    std::size_t bytesEach(SpzArray array) const;
};

/// Splits a file (versions 1 to 3: decompressed from gzip) into arrays of count times bytesEach. Throws Error if it is
/// invalid, truncated or of another version, and before allocating more memory than it can hold.
SpzFile openSpz(const InputFile& input);

} // namespace pointrt

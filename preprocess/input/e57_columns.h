// SPDX-License-Identifier: GPL-3.0-or-later
// What the columns of an E57 scan mean.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "format/pointio/e57.h"
#include "preprocess/input/sink.h"

namespace pointrt {

/// Names of the standard. Returns are counted from 0.
inline constexpr std::string_view kE57ReturnIndex = "returnIndex", kE57ReturnCount = "returnCount",
                                  kE57RowIndex = "rowIndex", kE57ColumnIndex = "columnIndex";

/// Three columns that belong together, by their numbers.
using E57Triple = std::array<std::size_t, 3>;

/// A column that becomes an attribute.
struct E57Attribute {
    std::size_t column;
    std::optional<std::size_t> invalid; ///< the column that says, not being 0, that the value means nothing
    Scalar type;
    std::size_t offset;   ///< in a point's packed values
    std::int64_t add = 0; ///< to a whole number
};

struct E57Plan {
    ScanTraits traits;
    std::optional<E57Triple> cartesian, spherical, normals, colors;
    std::optional<std::size_t> cartesian_invalid, spherical_invalid, color_invalid;
    std::vector<E57Attribute> attributes;
    /// Where colours have limits: the packed place of their 16 bits. Elsewhere the sink judges them by their values.
    std::optional<std::size_t> rgb16_offset;
    bool scaled_colors = false;  ///< colours have limits, which they are scaled by
    std::size_t value_bytes = 0; ///< of a point's packed values
    std::vector<bool> wanted;    ///< for each column, whether any of this needs it
};

/// Names of attributes are laspy's where the thing is one of LAS (return_number starts with 1, as there), others are as
/// in the file without an extension's prefix. Whole numbers keep the smallest type for their limits, scaled ones become
/// doubles, or less where that holds all of them. Colours of more than 8 bits, by their limits, are kept as rgb16,
/// which is the share of 65535. Throws Error (kBadInput, a reason without the file's name) for a scan without
/// coordinates and for two columns of one name.
/// @param returns_from_one the scan counts its returns as LAS does
E57Plan planE57(const E57Scan& scan, bool returns_from_one);

} // namespace pointrt

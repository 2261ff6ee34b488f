// SPDX-License-Identifier: GPL-3.0-or-later
// Meaning of the columns of an E57 scan.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "format/pointio/e57.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

/// Names from the standard. Returns count from 0.
inline constexpr std::string_view kE57ReturnIndex = "returnIndex", kE57ReturnCount = "returnCount",
                                  kE57RowIndex = "rowIndex", kE57ColumnIndex = "columnIndex";

/// Indices of three columns that belong together.
using E57Triple = std::array<std::size_t, 3>;

/// A column that becomes an attribute.
struct E57Attribute {
    std::size_t column;
    std::optional<std::size_t> invalid; ///< the column whose values other than 0 mark invalid values
    Scalar type;
    std::size_t offset;   ///< in a point's packed values, in bytes
    std::int64_t add = 0; ///< added to an integer
};

struct E57Plan {
    ScanTraits traits;
    std::optional<E57Triple> cartesian, spherical, normals, colors;
    std::optional<std::size_t> cartesian_invalid, spherical_invalid, color_invalid;
    std::vector<E57Attribute> attributes;
    /// Offset of 16-bit colours in the packed values, if colours have limits. Otherwise the sink chooses their scale.
    std::optional<std::size_t> rgb16_offset;
    bool scaled_colors = false;  ///< colours are scaled by their limits
    std::size_t value_bytes = 0; ///< size of a point's packed values
    std::vector<bool> used;      ///< [columns], whether the plan uses it
};

/// Attributes that LAS has take laspy's names (return_number starts with 1, as there); others keep the name in the
/// file, without an extension's prefix. Integers get the smallest type for their limits; scaled integers become
/// doubles, or floats if those hold all values. Colours of more than 8 bits, by their limits, are kept as rgb16, scaled
/// to 65535. Throws Error (kBadInput, a reason without the file's name) for a scan without coordinates or with
/// duplicate columns.
/// @param returns_from_one the scan counts returns from 1, as LAS does
E57Plan planE57(const E57Scan& scan, bool returns_from_one);

} // namespace pointrt

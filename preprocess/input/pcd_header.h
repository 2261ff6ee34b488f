// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PCD file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/columns.h"
#include "preprocess/input/roles.h"
#include "preprocess/input/scalar.h"
#include "preprocess/input/source.h"

namespace pointrt {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
    std::string name;
    std::size_t size = 4;
    char type = 'F';
    std::uint64_t count = 1;
    Scalar scalar = Scalar::kF32;
    Role role = kIgnored;
    bool packed_color = false;        ///< 0xRRGGBB in 32 bits of any type
    std::optional<std::size_t> place; ///< of an attribute: in a point's packed values
};

struct PcdHeader {
    std::vector<PcdField> fields;
    std::uint64_t points = 0;
    std::uint64_t grid_rows = 1, grid_columns = 0; ///< of organised points, one row after the other; else 1 row
    std::size_t point_size = 0;                    ///< bytes
    PcdData data = PcdData::kAscii;
    std::optional<Vec3d> sensor; ///< VIEWPOINT, where it means something
    std::string_view body;
    std::vector<ColumnTraits> columns; ///< what a point's packed values are
    std::size_t packed_size = 0;       ///< their bytes
    std::string unread;                ///< names of fields that are not, or ""
};

/// Reads the header. Throws Error when a line is malformed or there are no x, y and z. The points promised are not yet
/// checked against the bytes that follow.
PcdHeader readPcdHeader(const Source& source);

} // namespace pointrt

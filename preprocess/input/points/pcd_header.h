// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PCD file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/scalar.h"

namespace pointrt {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
    std::string name;
    std::size_t size = 4;
    char type = 'F';
    std::uint64_t count = 1;
    Scalar scalar = Scalar::kF32;
    Dimension dimension = kIgnored;
    bool packed_color = false;        ///< 0xRRGGBB in the 32 bits of any type
    std::optional<std::size_t> place; ///< of an attribute: offset in a point's packed values
};

struct PcdHeader {
    std::vector<PcdField> fields;
    std::uint64_t points = 0;
    std::uint64_t grid_rows = 1, grid_columns = 0; ///< of organised points, row by row; otherwise 1 row
    std::size_t point_size = 0;                    ///< bytes
    PcdData data = PcdData::kAscii;
    std::optional<Vec3d> sensor; ///< VIEWPOINT, if it is meaningful
    std::string_view body;
    std::vector<ColumnTraits> columns; ///< of a point's packed values
    std::size_t packed_size = 0;       ///< size of the packed values in bytes
    std::string unread;                ///< names of fields that are not read, or ""
};

/// Reads the header. Throws Error if a line is malformed or x, y or z is missing. Does not check the number of points
/// against the bytes that follow.
PcdHeader readPcdHeader(const InputFile& input);

} // namespace pointrt

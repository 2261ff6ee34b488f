// SPDX-License-Identifier: Apache-2.0
// Points with named columns: their description, and blocks of points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointrt/pro.h"

namespace pointrt {

/// The meaning of a column, for formats with dedicated fields.
enum class PointRole {
    kAttribute,
    kNormal, ///< 3 float; PLY: nx ny nz; omitted in LAS
    kRadius, ///< float; omitted in LAS
    kColor,  ///< 3 uint8, sRGB; PLY: red green blue; LAS: the colour, times 257
};

/// One or several numbers of one type for each point.
struct PointColumn {
    std::string name;             ///< laspy's names ("intensity", "gps_time") go to LAS fields
    std::uint32_t type = 0;       ///< PRO_TYPE_*
    std::uint32_t components = 1; ///< 1 to 4
    PointRole role = PointRole::kAttribute;
    /// Range of all finite values. If unknown, fields of LAS with fewer bits than the type are not used.
    std::optional<std::array<double, 2>> range = {};
    /// All values, if in memory, else null. LAS stores floats that are integers in integer fields.
    const void* values = nullptr;
    std::uint64_t value_rows = 0; ///< number of points in values

    std::size_t rowBytes() const { return std::size_t{pro_type_bytes(type)} * components; }
};

/// The description of points before reading the first.
struct PointOutline {
    std::vector<PointColumn> columns;                 ///< besides the positions, in the order of the file
    std::optional<std::uint64_t> count;               ///< none: unknown; not for standard output
    std::array<double, 3> bounds_min{}, bounds_max{}; ///< approximate; LAS derives its offset from them
    double position_step = 0;                         ///< resolution of positions; LAS uses a finer scale
    double metres_per_unit = 0;                       ///< 0: unknown or not lengths
    /// META of the .pro with the points. LAS takes the coordinate system from it, and header, scale and offset from
    /// "source_header".
    std::string metadata;
    bool keeps_source_scale = true; ///< of "source_header"; else LAS uses position_step
    std::string program;            ///< "NAME VERSION", for LAS
    std::string comment;            ///< for PLY, one line; or empty
};

/// Consecutive points.
struct PointBlock {
    std::vector<double> positions;               ///< [count][3], the scan's coordinates
    std::vector<std::vector<std::byte>> columns; ///< in the order of the outline, rowBytes() per point

    std::size_t count() const { return positions.size() / 3; }
};

/// The values of a column as numbers.
template <typename Number>
std::span<Number> numbersIn(std::vector<std::byte>& values) {
    return {reinterpret_cast<Number*>(values.data()), values.size() / sizeof(Number)};
}

} // namespace pointrt

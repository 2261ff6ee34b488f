// SPDX-License-Identifier: Apache-2.0
// Points with named columns of numbers: what is known of them beforehand, and blocks of them.
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

/// What files have a place of their own for.
enum class PointRole {
    kAttribute,
    kNormal, ///< 3 float; PLY: nx ny nz; LAS has no place for it and leaves it out
    kRadius, ///< float; LAS leaves it out
    kColor,  ///< 3 uint8, sRGB; PLY: red green blue; LAS: the colour, times 257
};

/// A few numbers of one type for each point.
struct PointColumn {
    std::string name;             ///< in LAS one that laspy knows ("intensity", "gps_time") goes to the field of it
    std::uint32_t type = 0;       ///< PRO_TYPE_*
    std::uint32_t components = 1; ///< 1 to 4
    PointRole role = PointRole::kAttribute;
    /// Least and most of all finite values. None: not known, and a field of LAS with fewer bits than the type is not
    /// taken.
    std::optional<std::array<double, 2>> range = {};
    /// All values, where they are in memory already: LAS looks whether real ones are whole numbers. Or null.
    const void* values = nullptr;
    std::uint64_t value_rows = 0; ///< points that they are of

    std::size_t rowBytes() const { return std::size_t{pro_type_bytes(type)} * components; }
};

/// What is known of a file's points before the first of them.
struct PointOutline {
    std::vector<PointColumn> columns;                 ///< besides the positions, in the order of the file
    std::optional<std::uint64_t> count;               ///< none: as many as come; not to standard output
    std::array<double, 3> bounds_min{}, bounds_max{}; ///< of the positions, nearly: LAS lays its offset by them
    double position_step = 0;                         ///< to which positions are exact: LAS keeps them to less
    double metres_per_unit = 0;                       ///< 0: not known, or no lengths
    /// META of the .pro that the points lie in: LAS takes the coordinate system from it, and from "source_header" its
    /// own header, scale and offset.
    std::string metadata;
    bool keeps_source_scale = true; ///< of "source_header"; else LAS goes by position_step all the same
    std::string program;            ///< "NAME VERSION", for LAS
    std::string comment;            ///< for PLY, one line; or empty
};

/// Points one behind the other.
struct PointBlock {
    std::vector<double> positions;               ///< [count][3], the scan's coordinates
    std::vector<std::vector<std::byte>> columns; ///< as the outline has them, rowBytes() a point

    std::size_t count() const { return positions.size() / 3; }
};

/// The values of a column as numbers.
template <typename Number>
std::span<Number> numbersIn(std::vector<std::byte>& values) {
    return {reinterpret_cast<Number*>(values.data()), values.size() / sizeof(Number)};
}

} // namespace pointrt

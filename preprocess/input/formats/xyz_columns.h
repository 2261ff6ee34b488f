// SPDX-License-Identifier: GPL-3.0-or-later
// What the columns of a point list without a header mean, judged by their values.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "preprocess/input/source/roles.h"

namespace pointrt {

/// What all rows say about the columns after x, y and z.
struct ColumnStatistics {
    static constexpr std::size_t kMax = 7; ///< columns after x, y, z that are looked at
    std::array<bool, kMax> whole;          ///< only whole numbers
    std::array<bool, kMax> unit;           ///< unit length, this column and the next two
    std::array<double, kMax> least, most;
    ColumnStatistics();
};

/// Takes the row's values after x, y, z into account, at most kMax of them.
void observe(ColumnStatistics& statistics, const double* extras, std::size_t count);

struct ColumnGuess {
    std::vector<Role> roles;  ///< one per column, x, y, z included
    bool real_colors = false; ///< colours are shares of 1
};

/// Column meanings of a list with column_count columns: 6 = normals or rgb, 7 = intensity rgb, rgb alpha or normals and
/// one more, 9 or 10 = rgb and normals in either order. Any other number of columns, and what looks like none of these,
/// is x, y, z alone.
ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count);

} // namespace pointrt

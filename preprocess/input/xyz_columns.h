// SPDX-License-Identifier: GPL-3.0-or-later
// What the columns of a point list without a header mean, judged by their values.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/input/roles.h"

namespace pointrt {

/// What all rows say about the columns after x, y and z.
struct ColumnStatistics {
    static constexpr std::size_t kMax = 7; ///< columns after x, y, z that are looked at
    std::array<bool, kMax> whole;          ///< only whole numbers
    /// Of this column and the next two: unit length wherever there is anything but zeros or NaN, and somewhere there
    /// is.
    std::array<bool, kMax> unit, directed;
    std::array<double, kMax> least, most;
    ColumnStatistics();
};

/// Takes the row's values after x, y, z into account, at most kMax of them.
void observe(ColumnStatistics& statistics, const double* extras, std::size_t count);

struct ColumnGuess {
    std::vector<Role> roles;              ///< one per column, x, y, z included
    bool real_colors = false;             ///< colours are shares of 1
    std::optional<std::size_t> intensity; ///< the column that is one for sure
    std::string doubt;                    ///< what a user should know about the guess, or empty
};

/// Column meanings of a list with column_count columns: 6 = normals or rgb, 7 = intensity rgb, rgb and alpha or
/// intensity, or normals and one more, 9 or 10 = normals and, before or after them, what 3 or 4 columns alone would be.
/// Any other number of columns, and what looks like none of these, is x, y, z alone. Colours are whole numbers up to
/// 65535 or shares of 1. Where four columns may be intensity and rgb in either order there is a doubt, but for .pts
/// files, as is_pts says, whose order it is that is taken. The one column beside colours, alpha apart, is an intensity
/// where there is no doubt; so is the fourth of a .pts file. What else is not read is told as a doubt.
ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count, bool is_pts);

} // namespace pointrt

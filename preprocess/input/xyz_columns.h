// SPDX-License-Identifier: GPL-3.0-or-later
// Guesses the meaning of the columns of a point list without a header from their values.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/ingest/dimensions.h"

namespace pointrt {

/// Statistics of the columns after x, y and z over all rows.
struct ColumnStatistics {
    static constexpr std::size_t kMax = 7; ///< columns after x, y, z that are examined
    std::array<bool, kMax> whole;          ///< integers only
    /// unit: in every row, this column and the next two are a unit vector, zeros or NaN. directed: in some row, a unit
    /// vector.
    std::array<bool, kMax> unit, directed;
    std::array<double, kMax> least, most;
    ColumnStatistics();
};

/// Adds a row's values after x, y, z, at most kMax of them.
void observe(ColumnStatistics& statistics, const double* extras, std::size_t count);

struct ColumnGuess {
    std::vector<Dimension> dimensions;    ///< one per column, including x, y, z
    bool real_colors = false;             ///< colours are in [0, 1]
    std::optional<std::size_t> intensity; ///< the intensity column, if unambiguous
    std::string doubt;                    ///< a note for the user about the guess, or empty
};

/// Guesses the columns of a list with column_count columns, of which the first three are x, y and z:
///  - 6: normals or rgb
///  - 7: rgb and an intensity or alpha, or normals and a column that is not read
///  - 9 or 10: normals and, before or after them, rgb, perhaps with an intensity or alpha
///  - others: only x, y and z are read
/// Colours are integers up to 65535, or numbers in [0, 1]. The intensity may be before or after rgb: if the values fit
/// both, the guess gets a doubt, except in .pts files (is_pts), whose order is known. The only column besides xyz,
/// normals and colours is an intensity, unless it is an alpha or there is a doubt. So is the fourth column of a .pts
/// file with four columns. Other columns are not read, which also gives a doubt.
ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count, bool is_pts);

} // namespace pointrt

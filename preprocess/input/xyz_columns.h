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
    /// This column and the next two are unit vectors, zeros or NaN, and at least one is a unit vector.
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

/// Column meanings of a list with column_count columns. 6: normals or rgb. 7: intensity and rgb, rgb and alpha or
/// intensity, or normals and one more. 9 or 10: normals and, before or after them, what 3 or 4 columns alone would be.
/// Otherwise only x, y, z are read. Colours are integers up to 65535 or in [0, 1]. If four columns may be intensity and
/// rgb in either order, the guess gets a doubt, except in .pts files (is_pts), whose order is used. A single column
/// beside colours that is not alpha is an intensity, if there is no doubt; so is the fourth of a .pts file. Other
/// columns that are not read also give a doubt.
ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count, bool is_pts);

} // namespace pointrt

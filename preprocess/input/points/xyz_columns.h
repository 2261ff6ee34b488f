// SPDX-License-Identifier: GPL-3.0-or-later
// Guesses the meaning of the columns of a point list without a header from their values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
    /// Sums of the values, of their squares and of their products with the next column.
    std::array<double, kMax> sum{}, squares{}, products{};
    std::uint64_t rows = 0;
    ColumnStatistics();
};

/// Adds a row's values after x, y, z, at most kMax of them.
void observe(ColumnStatistics& statistics, const double* extras, std::size_t count);

/// Statistics of the first four columns, for a point's number or time before x, y and z.
struct LeadStatistics {
    std::uint64_t rows = 0;
    bool ascends = true;  ///< so far each first value is above the previous one; for times, it may also be equal
    bool strictly = true; ///< none is equal
    bool counts = true;   ///< each is the one before plus 1
    double last = 0;
    std::array<double, 4> least, most;
    std::array<bool, 4> all_whole;
    LeadStatistics();
};

/// Adds a row's first four values.
void observe(LeadStatistics& statistics, const double* values);

enum class Lead { kNone, kNumber, kTime };

/// The meaning of the first column, if it is not x. described: words follow the numbers
Lead leadOf(const LeadStatistics& statistics, bool described);

/// Whether the second and third columns are a northing and an easting of UTM, in this order.
bool isNorthFirst(const LeadStatistics& statistics);

struct ColumnGuess {
    std::vector<Dimension> dimensions;    ///< one per column, including x, y, z
    bool real_colors = false;             ///< colours are in [0, 1]
    std::optional<std::size_t> intensity; ///< the intensity column, if unambiguous
    std::optional<std::size_t> label;     ///< the column of a class number beside red, green and blue
    std::string doubt;                    ///< a note for the user about the guess, or empty
};

/// Guesses the columns of a list with column_count columns, of which the first three are x, y and z:
///  - 6: normals or rgb
///  - 7: rgb and an intensity, alpha or label, or normals and a column that is not read
///  - 8: rgb up to 255 beside an intensity or a label, and as the last a label or the number of an object, which is not
///    read; or normals
///  - 9 or 10: normals and, before or after them, rgb, perhaps with an intensity or alpha
///  - others: only x, y and z are read
/// Colours are integers up to 65535, or numbers in [0, 1]. The intensity may be before or after rgb: if the values fit
/// both, the guess gets a doubt, except in .pts files (is_pts), whose order is known. The only column besides xyz,
/// normals and colours is an intensity, unless it is an alpha or there is a doubt. So is the fourth column of a .pts
/// file with four columns. Other columns are not read, which also gives a doubt.
/// @param before columns before x, for messages
ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count, bool is_pts,
                         std::size_t before = 0);

} // namespace pointrt

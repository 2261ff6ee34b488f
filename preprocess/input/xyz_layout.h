// SPDX-License-Identifier: GPL-3.0-or-later
// How to read the lines of a list of points: what stands before the first one says it, or the values do.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "preprocess/input/attribute_names.h"
#include "preprocess/input/sink.h"

namespace pointrt {

struct Layout {
    std::vector<Role> roles;        ///< one per column
    std::vector<std::string> names; ///< one per column, as the header has them; empty without a header
    bool real_colors = true;        ///< colours may be shares of 1
    char delimiter = ' ';
    bool counted = false;             ///< lines with one number say how many points follow
    std::uint64_t counted_points = 0; ///< by the first such line
    std::string_view data;            ///< from the first point on
    std::string_view first_line;
    std::size_t columns = 0; ///< of the first point that are numbers

    std::vector<ColumnTraits> attributes;
    std::vector<std::size_t> attribute_columns; ///< where each is

    bool named() const { return !names.empty(); }
    /// Leica's: a count, then x y z, intensity and red green blue, as far as they are there.
    bool isPts() const { return counted && !named(); }
};

/// Reads what stands before the first point. Throws Error when there is no point, or something else before it.
Layout readPrologue(const Source& source);

/// Makes a column an attribute, of whatever type its values turn out to need. False where another one has its name.
bool addAttribute(Layout& layout, std::size_t column, std::string_view name, AttributeNames& names);

} // namespace pointrt

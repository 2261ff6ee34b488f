// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a point list, from the lines before the first point.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "preprocess/ingest/attribute_names.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/number_style.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

struct Layout {
    std::vector<Dimension> dimensions;      ///< one per column
    std::vector<std::string> names;         ///< one per column, as in the header; empty without a header
    std::vector<std::string_view> left_out; ///< lines of words: titles before the header, units below it
    bool real_colors = true;                ///< colours may be in [0, 1]
    char delimiter = ' ';
    bool counted = false;             ///< lines with a single number give the number of points that follow
    std::uint64_t counted_points = 0; ///< from the first such line
    std::string_view data;            ///< from the first point on
    std::string_view first_line;
    std::size_t first = 0;    ///< column of the first number of a point, which words may precede
    std::size_t columns = 0;  ///< number of consecutive numbers of the first point from there on
    bool described = false;   ///< words follow them
    bool north_first = false; ///< y precedes x
    bool degrees = false;     ///< x and y are named longitude and latitude
    NumberStyle style;        ///< of the first points' numbers

    std::vector<ColumnTraits> attributes;
    std::vector<std::size_t> attribute_columns; ///< column of each attribute

    bool named() const { return !names.empty(); }
    /// Leica's format: a count, then x y z and optionally intensity and red green blue.
    bool isPts() const { return counted && !named(); }
};

/// Reads the lines before the first point. Throws Error if there is no point, or an invalid line before it.
Layout readPrologue(const InputFile& input);

/// How numbers of the first points are written.
NumberSurvey surveyNumbers(const Layout& layout);

/// Makes a column an untyped attribute. Returns false if its name is taken.
bool addAttribute(Layout& layout, std::size_t column, std::string_view name, AttributeNames& names);

} // namespace pointrt

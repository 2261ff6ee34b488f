// SPDX-License-Identifier: GPL-3.0-or-later
// What attributes are called: one thing has one name, however the program that wrote the file spells it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The name of an attribute that a file calls `written`: that of laspy for what LAS has, whatever its case, the
/// underscores and blanks in it and CloudCompare's "scalar_" before it; else the word itself, as UTF-8 of at most 31
/// bytes without control characters. "" where nothing is left of it.
std::string attributeName(std::string_view written);

/// Names the columns of one file, no two alike.
class AttributeNames {
public:
    /// The attribute's name, or the word as it is written where another column has that name; nothing where that is
    /// taken too.
    std::optional<std::string> take(std::string_view written);

private:
    std::vector<std::string> taken_;
};

} // namespace pointrt

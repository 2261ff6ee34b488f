// SPDX-License-Identifier: GPL-3.0-or-later
// Names of attributes: one name for one quantity, however the program that wrote the file spells it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The name of an attribute that a file calls `written`: laspy's name for a LAS field, ignoring case, underscores,
/// blanks and CloudCompare's prefix "scalar_"; else the word itself, as UTF-8 of at most 31 bytes without control
/// characters. "" if nothing is left of it.
std::string attributeName(std::string_view written);

/// Names the columns of one file uniquely.
class AttributeNames {
public:
    /// The attribute's name, or the column's original name if another column has the attribute's name; nullopt if that
    /// is taken too.
    std::optional<std::string> take(std::string_view written);

private:
    std::vector<std::string> taken_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Text files of numbers in columns that have names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// Numbers of a file, row by row; all of them finite.
struct NumberTable {
    std::string path;
    std::vector<std::string> names;   ///< of the columns, lower case
    std::vector<double> numbers;      ///< [rows][columns]
    std::vector<std::uint32_t> lines; ///< of each row, from 1

    std::size_t rows() const { return lines.size(); }
    double at(std::size_t row, std::size_t column) const { return numbers[row * names.size() + column]; }
    std::optional<std::size_t> find(std::string_view name) const;
    /// Throws Error kBadInput where the table has it not. owner: what should have it, "a trajectory".
    std::size_t require(std::string_view name, const std::string& owner) const;
    /// Throws Error kBadInput "FILE:LINE: reason".
    [[noreturn]] void refuse(std::size_t row, const std::string& reason) const;
};

/// Columns are apart by commas, semicolons or blanks; empty lines, and those that begin with #, are passed over; the
/// first of the others names the columns. Throws Error kBadInput "FILE[:LINE]: reason", where there is no row, too.
NumberTable readNumberTable(const std::string& path);

} // namespace pointrt

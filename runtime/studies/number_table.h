// SPDX-License-Identifier: Apache-2.0
// Text files with named columns of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The rows of a file; all numbers are finite.
struct NumberTable {
    std::string path;
    std::vector<std::string> names;   ///< of the columns, lower case
    std::vector<double> numbers;      ///< [rows][columns]
    std::vector<std::uint32_t> lines; ///< of each row, from 1

    std::size_t rows() const { return lines.size(); }
    double at(std::size_t row, std::size_t column) const { return numbers[row * names.size() + column]; }
    std::optional<std::size_t> find(std::string_view name) const;
    /// Throws Error kBadInput if there is no such column.
    /// @param owner of the column, for messages: "a trajectory"
    std::size_t require(std::string_view name, const std::string& owner) const;
    /// Throws Error kBadInput "FILE:LINE: reason".
    [[noreturn]] void refuse(std::size_t row, const std::string& reason) const;
};

/// Columns are separated by commas, semicolons or blanks. Skips empty lines and comments starting with #; the first
/// other line names the columns. Throws Error kBadInput "FILE[:LINE]: reason", also if there are no rows.
NumberTable readNumberTable(const std::string& path);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/number_table.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/util/input_file.h"
#include "runtime/util/parse.h"
#include "runtime/util/words.h"

namespace pointrt {
namespace {

[[noreturn]] void refuseLine(const std::string& path, std::uint32_t line, const std::string& reason) {
    throw Error(ExitCode::kBadInput, path + ":" + std::to_string(line) + ": " + reason);
}

void takeNames(const std::vector<std::string_view>& words, std::uint32_t line, NumberTable& table) {
    double number = 0;
    for (const std::string_view word : words) {
        if (parseNumber(std::string(word), number))
            refuseLine(table.path, line,
                       "the first line must name the columns, but \"" + printable(word) + "\" is a number");
        table.names.push_back(lowerCase(word));
        if (std::count(table.names.begin(), table.names.end(), table.names.back()) > 1)
            refuseLine(table.path, line, "duplicate column \"" + printable(word) + "\"");
    }
}

void takeRow(const std::vector<std::string_view>& words, std::uint32_t line, NumberTable& table) {
    if (words.size() != table.names.size())
        refuseLine(table.path, line,
                   std::to_string(words.size()) + " numbers in " + std::to_string(table.names.size()) + " columns");
    for (std::string_view word : words) {
        if (word.starts_with('+')) word.remove_prefix(1);
        double number = 0;
        if (!parseNumber(std::string(word), number) || !std::isfinite(number))
            refuseLine(table.path, line, "\"" + printable(word) + "\" is not a finite number");
        table.numbers.push_back(number);
    }
    table.lines.push_back(line);
}

} // namespace

std::optional<std::size_t> NumberTable::find(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t NumberTable::require(std::string_view name, const std::string& owner) const {
    if (const auto column = find(name)) return *column;
    std::string columns;
    for (const std::string& each : names) columns += (columns.empty() ? "" : ", ") + printable(each);
    throw Error(ExitCode::kBadInput,
                path + ": " + owner + " needs the column \"" + std::string(name) + "\"; the columns are " + columns);
}

void NumberTable::refuse(std::size_t row, const std::string& reason) const { refuseLine(path, lines[row], reason); }

NumberTable readNumberTable(const std::string& path) {
    const std::vector<std::uint8_t> bytes = readFileBytes(path);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    NumberTable table;
    table.path = path;
    for (std::uint32_t line = 1; !text.empty(); ++line) {
        const std::string_view one = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(one.size() + 1, text.size()));
        const std::vector<std::string_view> words = wordsOf(one);
        if (words.empty() || words.front().starts_with('#')) continue;
        if (table.names.empty())
            takeNames(words, line, table);
        else
            takeRow(words, line, table);
    }
    if (table.lines.empty()) throw Error(ExitCode::kBadInput, path + ": has no rows of numbers");
    return table;
}

} // namespace pointrt

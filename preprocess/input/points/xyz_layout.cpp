// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/xyz_layout.h"

#include <algorithm>
#include <optional>

#include "preprocess/ingest/axis_names.h"
#include "preprocess/ingest/number_style.h"
#include "preprocess/ingest/table.h"

namespace pointrt {
namespace {

constexpr std::size_t kMaxColumns = 4096;

/// The names of the columns, without units such as "[m]" or "(m)".
std::vector<std::string> namesOf(std::string_view line, char delimiter) {
    std::vector<std::string> names;
    Fields fields{line, delimiter};
    for (std::string_view field; names.size() < kMaxColumns && fields.next(field);)
        names.emplace_back(Fields::trim(field.substr(0, field.find_first_of("[("))));
    while (!names.empty() && names.back().empty()) names.pop_back();
    return names;
}

/// Parses a line as the header. Returns false if it does not name x, y and z.
bool takeHeader(std::string_view line, char delimiter, Layout& layout) {
    std::vector<std::string> names = namesOf(line, delimiter);
    std::vector<Dimension> dimensions;
    for (const std::string& name : names) dimensions.push_back(dimensionOfName(name));
    const bool degrees = findAxes(names, dimensions);
    resolveDimensions(dimensions);
    if (!hasPositions(dimensions)) return false;
    layout.dimensions = std::move(dimensions);
    layout.names = std::move(names);
    layout.degrees = degrees;
    return true;
}

/// Whether a field marks a missing number: the first point of a grid often has no height.
bool isMissingWord(std::string_view field) { return !field.empty() && isMissingNumber(field); }

/// Number of fields in a line; its first run of numbers.
struct LineShape {
    std::size_t fields = 0, first = 0, numbers = 0;
    bool whole = false; ///< the first field is an integer without a sign
};

LineShape shapeOf(std::string_view line, char delimiter) {
    LineShape shape;
    Fields fields{line, delimiter};
    for (std::string_view field; fields.next(field); ++shape.fields) {
        std::uint64_t count = 0;
        if (shape.fields == 0) shape.whole = wholeInteger(field, count);
        if (shape.numbers == 0) shape.first = shape.fields;
        if (shape.first + shape.numbers != shape.fields) continue;
        const bool is_number = isAnyNumber(field), is_missing = shape.numbers >= 2 && isMissingWord(field);
        shape.numbers += is_number || is_missing;
    }
    return shape;
}

/// A point: three numbers, after no more words than a name, a date and a time.
bool isPoint(const LineShape& shape) {
    constexpr std::size_t kMostWords = 3;
    return shape.numbers >= 3 && shape.first <= kMostWords;
}

/// The delimiter that the first line of a file may set for spreadsheets: "sep=;".
std::optional<char> separatorOf(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() != 5 || (!line.starts_with("sep=") && !line.starts_with("SEP="))) return std::nullopt;
    constexpr std::string_view kSeparators = ",;|\t";
    return kSeparators.find(line.back()) != kSeparators.npos ? std::optional(line.back()) : std::nullopt;
}

/// Whether a line numbers the columns from 0, perhaps after an empty field over the rows' numbers: pandas writes this
/// header for arrays. next: the line after it, which has decimals
bool numbersColumns(std::string_view line, std::string_view next) {
    std::size_t count = 0;
    Fields fields{line, ','};
    for (std::string_view field; fields.next(field);) {
        if (field.empty() && count == 0 && line.starts_with(',')) continue;
        std::size_t number = 0;
        if (!wholeInteger(field, number) || number != count++) return false;
    }
    return count >= 3 && next.find('.') != next.npos;
}

bool isCount(const LineShape& shape) { return shape.fields == 1 && shape.whole; }

void takeCount(const InputFile& input, std::string_view line, Layout& layout) {
    if (layout.counted) refuseLine(input, line.data(), "a second count before the first point");
    layout.counted = true;
    wholeInteger(line, layout.counted_points);
}

/// The delimiter is that of the header line if the point has it: words may contain others.
void takeFirstPoint(std::string_view data, std::string_view line, char delimiter, const LineShape& shape,
                    Layout& layout) {
    layout.data = data;
    const bool as_header = layout.named() && layout.delimiter != ' ' && line.find(layout.delimiter) != line.npos;
    if (!as_header) layout.delimiter = delimiter;
    layout.first = shape.first;
    layout.columns = shape.numbers;
    layout.described = shape.first + shape.numbers < shape.fields;
    layout.first_line = trimmedRecord(line, layout.delimiter);
}

/// Whether a line below the header has words and no number: units, such as m,m,m,-.
bool isUnitLine(std::string_view line, char delimiter) {
    Fields fields{line, delimiter};
    std::size_t words = 0;
    for (std::string_view field; fields.next(field);) {
        if (isAnyNumber(field)) return false;
        words += !field.empty() && !isMissingWord(field);
    }
    return words >= 3;
}

[[noreturn]] void refuseTitle(const InputFile& input, std::string_view line) {
    refuseLine(input, line.data(), fmt::format("neither a point nor a header with x, y and z: {}", inQuotes(line)));
}

/// Words before the points are titles only if a header follows them.
void requireHeaderAfterTitles(const InputFile& input, const Layout& layout) {
    if (!layout.named() && !layout.left_out.empty()) refuseTitle(input, layout.left_out.front());
}

/// Takes a line that is neither header nor point: a title, if a header follows.
void takeTitle(const InputFile& input, std::string_view line, Layout& layout) {
    constexpr std::size_t kMostTitles = 10;
    layout.left_out.push_back(line);
    if (layout.left_out.size() > kMostTitles) refuseTitle(input, layout.left_out.front());
}

/// Whether a column of the first point is read as a number: if no header decides that, all columns of its first run
/// are.
bool isNumberColumn(const Layout& layout, std::size_t column) {
    if (layout.named()) return column < layout.dimensions.size() && layout.dimensions[column] != kIgnored;
    return column >= layout.first && column < layout.first + layout.columns;
}

} // namespace

NumberSurvey surveyNumbers(const Layout& layout) {
    constexpr int kRecords = 1000; // enough to find a number that only one style fits
    NumberSurvey survey;
    std::string_view rest = layout.data, record;
    for (int i = 0; i < kRecords && nextRecord(rest, record, layout.delimiter); ++i) {
        const std::string_view trimmed = trimmedRecord(record, layout.delimiter);
        if (commentText(trimmed)) continue;
        Fields fields{trimmed, layout.delimiter};
        std::string_view field;
        for (std::size_t column = 0; column < kMaxColumns && fields.next(field); ++column)
            if (isNumberColumn(layout, column)) survey.add(field);
    }
    return survey;
}

Layout readPrologue(const InputFile& input) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    Layout layout;
    std::optional<char> separator;
    bool rows_are_numbered = false, has_units = false;
    std::string_view rest = input.bytes, line;
    if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
    const auto next = [&] { return nextRecord(rest, line, layout.named() ? layout.delimiter : ' '); };
    for (std::string_view here = rest; next(); here = rest) {
        const std::string_view untrimmed = line;
        line = withoutBlanks(line);
        if (line.empty()) continue;
        if (const auto comment = commentText(line)) {
            if (!layout.named()) takeHeader(*comment, delimiterOf(*comment), layout);
            continue;
        }
        if (const auto found = separatorOf(untrimmed)) {
            separator = found;
            continue;
        }
        const char delimiter = separator.value_or(delimiterOf(line));
        if (!layout.named() && delimiter == ',' && numbersColumns(line, rest.substr(0, rest.find('\n')))) {
            rows_are_numbered = line.starts_with(',');
            continue;
        }
        LineShape shape = shapeOf(line, delimiter);
        if (rows_are_numbered && shape.numbers > 3) {
            ++shape.first;
            --shape.numbers;
        }
        if (isCount(shape)) {
            takeCount(input, line, layout);
        } else if (takeHeader(line, delimiter, layout)) {
            layout.delimiter = delimiter;
        } else if (layout.named() && isUnitLine(line, delimiter) && !has_units) {
            has_units = true;
            layout.left_out.push_back(line);
        } else if (isPoint(shape) || layout.named()) {
            requireHeaderAfterTitles(input, layout);
            takeFirstPoint(here, untrimmed, delimiter, shape, layout);
            return layout;
        } else {
            takeTitle(input, line, layout);
        }
    }
    requireHeaderAfterTitles(input, layout);
    refuse(input, "holds no points");
}

bool addAttribute(Layout& layout, std::size_t column, std::string_view name, AttributeNames& names) {
    const auto taken = names.take(name);
    if (!taken) return false;
    layout.attributes.push_back({*taken, Scalar::kF64, 1, true});
    layout.attribute_columns.push_back(column);
    return true;
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/xyz_layout.h"

#include <algorithm>

#include "preprocess/ingest/table.h"

namespace pointrt {
namespace {

constexpr std::size_t kMaxColumns = 4096;

/// The names of the columns, without units such as "[m]" or "(m)".
std::vector<std::string> namesOf(std::string_view line) {
    std::vector<std::string> names;
    Fields fields{line, delimiterOf(line)};
    for (std::string_view field; names.size() < kMaxColumns && fields.next(field);)
        names.emplace_back(Fields::trim(field.substr(0, field.find_first_of("[("))));
    return names;
}

/// Parses a line as the header. Returns false if it does not name x, y and z.
bool takeHeader(std::string_view line, Layout& layout) {
    std::vector<std::string> names = namesOf(line);
    std::vector<Dimension> dimensions;
    for (const std::string& name : names) dimensions.push_back(dimensionOfName(name));
    resolveDimensions(dimensions);
    if (!hasPositions(dimensions)) return false;
    layout.dimensions = std::move(dimensions);
    layout.names = std::move(names);
    return true;
}

/// Number of fields in a line, and of leading numbers.
struct LineShape {
    std::size_t fields = 0, numbers = 0;
    bool whole = false; ///< the first one is an integer without a sign
};

LineShape shapeOf(std::string_view line) {
    LineShape shape;
    Fields fields{line, delimiterOf(line)};
    for (std::string_view field; fields.next(field); ++shape.fields) {
        double value = 0;
        std::uint64_t count = 0;
        if (shape.fields == 0) shape.whole = wholeInteger(field, count);
        if (shape.numbers == shape.fields && wholeNumber(field, value)) ++shape.numbers;
    }
    return shape;
}

bool isCount(const LineShape& shape) { return shape.fields == 1 && shape.whole; }

void takeCount(const InputFile& input, std::string_view line, Layout& layout) {
    if (layout.counted) refuseLine(input, line.data(), "a second count before the first point");
    layout.counted = true;
    wholeInteger(line, layout.counted_points);
}

} // namespace

Layout readPrologue(const InputFile& input) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    Layout layout;
    std::string_view rest = input.bytes, line;
    if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
    for (std::string_view here = rest; nextLine(rest, line); here = rest) {
        line = withoutBlanks(line);
        if (line.empty()) continue;
        if (const auto comment = commentText(line)) {
            if (!layout.named()) takeHeader(*comment, layout);
            continue;
        }
        const LineShape shape = shapeOf(line);
        if (isCount(shape)) {
            takeCount(input, line, layout);
        } else if (takeHeader(line, layout)) {
            continue;
        } else if (shape.numbers >= 3 || layout.named()) {
            layout.data = here;
            layout.delimiter = delimiterOf(line);
            layout.columns = shape.numbers;
            layout.first_line = line;
            return layout;
        } else {
            refuseLine(
                input, line.data(),
                fmt::format("neither a point nor a header with x, y and z: {}{}", inQuotes(line), commaHint(line)));
        }
    }
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

// SPDX-License-Identifier: GPL-3.0-or-later
// Point lists as text: a point a line, in columns.
#include <algorithm>
#include <optional>

#include "preprocess/input/formats/formats.h"
#include "preprocess/input/formats/text/xyz_columns.h"
#include "preprocess/input/source/text.h"

namespace pointrt {
namespace {

/// The fields of one line. The delimiter is a comma, a semicolon or, as ' ', any run of blanks.
struct Fields {
    std::string_view rest;
    char delimiter;

    bool next(std::string_view& field) {
        if (delimiter == ' ') {
            field = nextWord(rest);
            return !field.empty();
        }
        if (rest.empty()) return false;
        const std::size_t length = rest.find(delimiter);
        field = trim(rest.substr(0, length));
        rest.remove_prefix(length == std::string_view::npos ? rest.size() : length + 1);
        return true;
    }

    static std::string_view trim(std::string_view field) {
        const auto skipped = [](char letter) { return isBlank(letter) || letter == '"'; };
        while (!field.empty() && skipped(field.front())) field.remove_prefix(1);
        while (!field.empty() && skipped(field.back())) field.remove_suffix(1);
        return field;
    }
};

/// How to read the lines of a list.
struct Layout {
    std::vector<Role> roles; ///< one per column
    bool named = false;      ///< by a header
    bool real_colors = true; ///< colours may be shares of 1
    char delimiter = ' ';
    bool counted = false;             ///< as .pts: lines with one number say how many points follow
    std::uint64_t counted_points = 0; ///< by the first such line
    std::string_view data;            ///< from the first point on
    std::size_t columns = 0;          ///< of the first point
    std::size_t first_line_size = 0;
};

char delimiterOf(std::string_view line) {
    if (line.find(';') != std::string_view::npos) return ';';
    return line.find(',') != std::string_view::npos ? ',' : ' ';
}

std::string_view withoutBlanks(std::string_view line) {
    while (!line.empty() && isSpace(line.front())) line.remove_prefix(1);
    while (!line.empty() && isSpace(line.back())) line.remove_suffix(1);
    return line;
}

/// The text of a comment line; nothing for other lines.
std::optional<std::string_view> commentText(std::string_view line) {
    if (line.starts_with("//")) return line.substr(2);
    if (line.starts_with("#")) return line.substr(1);
    return std::nullopt;
}

std::vector<Role> rolesOfHeader(std::string_view line) {
    constexpr std::size_t kMaxColumns = 4096;
    std::vector<Role> roles;
    Fields fields{line, delimiterOf(line)};
    for (std::string_view field; roles.size() < kMaxColumns && fields.next(field);) {
        const std::string_view name = Fields::trim(field.substr(0, field.find_first_of("[(")));
        roles.push_back(roleOfName(name));
    }
    settleRoles(roles);
    return hasPositions(roles) ? roles : std::vector<Role>();
}

/// What to say of a line with numbers such as 1,5; nothing of others.
std::string_view commaHint(std::string_view line) {
    int commas = 0;
    while (!line.empty()) {
        const std::size_t length = std::min(line.find_first_of(" \t;"), line.size());
        std::string word(Fields::trim(line.substr(0, length)));
        line.remove_prefix(std::min(length + 1, line.size()));
        const std::size_t comma = word.find(',');
        if (comma == std::string::npos || word.find('.') != std::string::npos) continue;
        word[comma] = '.';
        double value = 0;
        commas += wholeNumber(word, value) && word.back() != '.';
    }
    return commas > 1 ? " (decimal commas? write 1.5 for 1,5)" : "";
}

/// How many fields a line has, and how many numbers it starts with.
struct LineShape {
    std::size_t fields = 0, numbers = 0;
    bool whole = false; ///< the first one is a whole number without a sign
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

void takeCount(const Source& source, std::string_view line, Layout& layout) {
    if (layout.counted) refuse(source, fmt::format("is a PTX scan; this build reads {}", readableFormats()));
    layout.counted = true;
    wholeInteger(line, layout.counted_points);
}

/// Reads what stands before the first point.
Layout readPrologue(const Source& source) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    Layout layout;
    std::string_view rest = source.bytes, line;
    if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
    for (std::string_view here = rest; nextLine(rest, line); here = rest) {
        line = withoutBlanks(line);
        if (line.empty()) continue;
        if (const auto comment = commentText(line)) {
            if (!layout.named) layout.roles = rolesOfHeader(*comment);
            layout.named = layout.named || !layout.roles.empty();
            continue;
        }
        const LineShape shape = shapeOf(line);
        if (isCount(shape)) {
            takeCount(source, line, layout);
        } else if (const std::vector<Role> roles = rolesOfHeader(line); !roles.empty()) {
            layout.roles = roles;
            layout.named = true;
        } else if (shape.numbers >= 3 || layout.named) {
            layout.data = here;
            layout.delimiter = delimiterOf(line);
            layout.columns = shape.numbers;
            layout.first_line_size = here.size() - rest.size();
            return layout;
        } else {
            refuseLine(
                source, line.data(),
                fmt::format("is neither a point nor a header with x, y and z: {}{}", quoted(line), commaHint(line)));
        }
    }
    refuse(source, "holds no points");
}

/// Parses the wanted columns of one line into values. Throws Error when one is missing or no number.
void parseRow(const Source& source, std::string_view line, char delimiter, const std::vector<bool>& wanted,
              double* values) {
    Fields fields{line, delimiter};
    std::string_view field;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!fields.next(field))
            refuseLine(source, line.data(), fmt::format("has {} columns, {} are needed", i, wanted.size()));
        if (wanted[i] && !wholeNumber(field, values[i]))
            refuseLine(source, line.data(),
                       fmt::format("column {} is no number: {}{}", i + 1, quoted(field), commaHint(line)));
    }
}

/// Calls use(values) for each point, with the values of the wanted columns. Returns how many points the count lines
/// announce, none if there are none.
template <typename Use>
std::uint64_t forEachRow(const Source& source, const Layout& layout, const std::vector<bool>& wanted, Use&& use) {
    std::vector<double> values(wanted.size());
    std::uint64_t announced = layout.counted_points;
    std::string_view rest = layout.data, line;
    while (nextLine(rest, line)) {
        const std::string_view trimmed = withoutBlanks(line);
        if (trimmed.empty() || commentText(trimmed)) continue;
        std::uint64_t count = 0;
        if (layout.counted && wholeInteger(trimmed, count)) {
            if (__builtin_add_overflow(announced, count, &announced))
                refuseLine(source, line.data(), "impossible count");
            continue;
        }
        parseRow(source, trimmed, layout.delimiter, wanted, values.data());
        use(values.data());
    }
    return announced;
}

/// Columns without a header are told by their values, in a pass of its own.
void guessRoles(const Source& source, Layout& layout, Sink& sink) {
    const std::size_t extras = layout.columns - 3;
    ColumnStatistics statistics;
    if (extras > 1 && extras <= ColumnStatistics::kMax)
        forEachRow(source, layout, std::vector<bool>(layout.columns, true),
                   [&](const double* values) { observe(statistics, values + 3, extras); });
    ColumnGuess guess = guessColumns(statistics, layout.columns, layout.counted);
    if (!guess.doubt.empty()) addNote(sink.cloud, source.name, guess.doubt);
    layout.roles = std::move(guess.roles);
    layout.real_colors = guess.real_colors;
}

ScanTraits traitsOf(const Layout& layout) {
    ScanTraits traits;
    traits.normals = hasNormals(layout.roles);
    traits.colors = hasColors(layout.roles);
    traits.color_scale = layout.real_colors ? ColorScale::kReal : ColorScale::kInteger;
    traits.vertices = layout.data.size() / layout.first_line_size + 1;
    return traits;
}

void readXyz(const Source& source, Sink& sink) {
    Layout layout = readPrologue(source);
    if (!layout.named) guessRoles(source, layout, sink);
    while (layout.roles.back() == kIgnored) layout.roles.pop_back();
    std::vector<bool> wanted;
    for (const Role role : layout.roles) wanted.push_back(role != kIgnored);
    beginScan(sink, source, traitsOf(layout));
    Row row{};
    const std::uint64_t announced = forEachRow(source, layout, wanted, [&](const double* values) {
        for (std::size_t i = 0; i < wanted.size(); ++i) row[layout.roles[i]] = values[i];
        addVertex(sink, row);
    });
    if (announced > sink.vertices)
        refuse(source, fmt::format("cut short: {} of {} points are there", sink.vertices, announced));
    finishScan(sink, source);
}

} // namespace

const FormatReader readers::kXyz{.read = readXyz};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Point lists as text: one point per line, in columns.
#include <algorithm>
#include <limits>
#include <memory>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/table.h"
#include "preprocess/input/points/xyz_columns.h"
#include "preprocess/input/points/xyz_layout.h"

namespace pointrt {
namespace {

/// Requirement on a column of each line.
enum class Need { kNothing, kNumber, kNumberOrNot };

struct RowReader {
    const InputFile& input;
    const Layout& layout;
    std::vector<Need> needs; ///< one per column, up to the last that is read
    std::vector<double> values;
    std::size_t needed = 0;       ///< number of columns up to the last required number
    std::uint64_t not_number = 0; ///< missing or malformed optional values so far
    std::uint64_t missing = 0;    ///< rows that lack a required number
    NumberStyle style;            ///< of the numbers so far
    bool salvages = false;        ///< ignore an incomplete last line
    bool is_cut = false;          ///< there was one

    RowReader(const InputFile& from, const Layout& how, std::vector<Need> what)
        : input(from), layout(how), needs(std::move(what)), values(needs.size()), style(how.style) {
        for (std::size_t i = 0; i < needs.size(); ++i)
            if (needs[i] == Need::kNumber) needed = i + 1;
    }

    /// Parses one record into values. A required number that is marked as missing becomes NaN. Throws Error if one is
    /// absent or malformed.
    void parse(std::string_view line) {
        Fields fields{line, layout.delimiter};
        std::string_view field;
        bool lacks = false;
        for (std::size_t i = 0; i < needs.size(); ++i) {
            if (needs[i] != Need::kNothing && style.isPlain() && fields.nextNumber(values[i])) continue;
            const bool there = fields.next(field);
            if (!there && i < needed)
                refuseLine(input, line.data(), fmt::format("has {} columns, but {} are needed", i, needed));
            if (needs[i] == Need::kNothing || (there && takeNumber(line, field, values[i]))) continue;
            values[i] = std::numeric_limits<double>::quiet_NaN();
            if (needs[i] == Need::kNumberOrNot)
                ++not_number;
            else if (isMissingNumber(field))
                lacks = true;
            else
                refuseLine(input, line.data(), fmt::format("column {} is not a number: {}", i + 1, inQuotes(field)));
        }
        missing += lacks;
    }

private:
    bool takeNumber(std::string_view line, std::string_view field, double& value) {
        if (style.isPlain() ? wholeNumber(field, value) : styledNumber(field, style, value)) return true;
        if (!isAnyNumber(field)) return false;
        takeStyle(line, field);
        return styledNumber(field, style, value);
    }

    /// Changes to the style of a number that contradicts the style so far. Throws Error if the two styles read the
    /// earlier numbers differently, or if the number fits several styles.
    void takeStyle(std::string_view line, std::string_view field) {
        const NumberStyle* found = nullptr;
        double value = 0;
        for (const NumberStyle& other : numberStyles()) {
            if (!styledNumber(field, other, value) || !mayBecome(other, line)) continue;
            if (found && found->decimal != other.decimal) refuseMixed(line);
            if (!found) found = &other;
        }
        if (!found) refuseMixed(line);
        style = *found;
    }

    /// Whether the numbers before a line have the same values in another style.
    bool mayBecome(const NumberStyle& other, std::string_view line) const {
        if (!style.group.empty()) return false;
        const std::string_view before =
            layout.data.substr(0, static_cast<std::size_t>(line.data() - layout.data.data()));
        return other.decimal == style.decimal || (style.isPlain() && before.find('.') == before.npos);
    }

    [[noreturn]] void refuseMixed(std::string_view line) const {
        refuseLine(input, line.data(),
                   "mixes decimal commas, decimal points and thousands separators: 1,234 may be either");
    }
};

/// Whether to leave out a last line without a line end: more points are announced, or it is not a point. Throws Error
/// in these cases unless the file is salvaged.
bool endsWithin(RowReader& reader, std::string_view line, std::uint64_t rows, std::uint64_t announced) {
    if (rows + 1 < announced) return true;
    try {
        RowReader(reader).parse(line);
        return false;
    } catch (const Error& error) {
        reader.is_cut = reader.salvages && rows > 0;
        if (reader.is_cut) return true;
        if (rows == 0) throw;
        throw Error(error.code, fmt::format("{}; --salvage reads the {} points before it", error.what(), rows));
    }
}

/// Calls use() for each point, whose values are in the reader, until it returns false. Returns the sum of the count
/// lines; 0 in a file without them.
template <typename Use>
std::uint64_t forEachRow(RowReader& reader, Use&& use) {
    const Layout& layout = reader.layout;
    std::uint64_t announced = layout.counted_points, rows = 0;
    std::string_view rest = layout.data, line;
    ReleasePagesBehind release_pages{reader.input};
    while (nextRecord(rest, line, layout.delimiter)) {
        release_pages(static_cast<std::uint64_t>(line.data() - reader.input.begin()));
        const std::string_view trimmed = trimmedRecord(line, layout.delimiter);
        if (trimmed.empty() || commentText(trimmed)) continue;
        std::uint64_t count = 0;
        if (layout.counted && wholeInteger(trimmed, count)) {
            if (__builtin_add_overflow(announced, count, &announced))
                refuseLine(reader.input, line.data(), "impossible count");
            continue;
        }
        if (trimmed.data() + trimmed.size() == reader.input.end() && endsWithin(reader, trimmed, rows, announced))
            break;
        reader.parse(trimmed);
        ++rows;
        if (!use()) break;
    }
    return announced;
}

/// Requirement for each column, from the layout's first on, without a header.
std::vector<Need> numbersOf(const Layout& layout) {
    std::vector<Need> needs(layout.first, Need::kNothing);
    needs.resize(layout.first + layout.columns, Need::kNumber);
    return needs;
}

/// Takes a number or a time of the point from the columns before x, y and z. Returns a note about them, or "".
std::string takeLead(const InputFile& input, bool salvages, Layout& layout, AttributeNames& names) {
    if (layout.columns < 4 || layout.isPts()) return {};
    LeadStatistics statistics;
    RowReader reader(input, layout, numbersOf(layout));
    reader.salvages = salvages;
    forEachRow(reader, [&] {
        observe(statistics, reader.values.data() + layout.first);
        return statistics.ascends;
    });
    const Lead lead = leadOf(statistics, layout.described);
    if (lead == Lead::kNone) return {};
    const std::size_t column = layout.first++;
    --layout.columns;
    addAttribute(layout, column, lead == Lead::kTime ? "time" : "number", names);
    const bool north_first = layout.columns == 3 && layout.described && isNorthFirst(statistics);
    layout.north_first = north_first;
    return fmt::format("has no header: column {} looks like the {} of the point, columns {} to {} are read as {}; a "
                       "header line such as 'number,x,y,z' or 'P,N,E,Z,D' names them",
                       column + 1, lead == Lead::kTime ? "time" : "number", column + 2, column + 4,
                       north_first ? "north, east and height" : "x, y and z");
}

/// Guesses the columns of a list without a header in separate passes over its values.
void guessDimensions(const InputFile& input, Layout& layout, Sink& sink) {
    AttributeNames names;
    const bool salvages = sink.salvages;
    if (const std::string note = takeLead(input, salvages, layout, names); !note.empty()) sink.note(input, note);
    const std::size_t extras = layout.columns - 3;
    ColumnStatistics statistics;
    RowReader reader(input, layout, numbersOf(layout));
    reader.salvages = salvages;
    if (extras > 1 && extras <= ColumnStatistics::kMax)
        forEachRow(reader, [&] {
            observe(statistics, reader.values.data() + layout.first + 3, extras);
            return true;
        });
    ColumnGuess guess = guessColumns(statistics, layout.columns, layout.counted, layout.first);
    if (!guess.doubt.empty()) sink.note(input, guess.doubt);
    layout.dimensions.assign(layout.first, kIgnored);
    layout.dimensions.insert(layout.dimensions.end(), guess.dimensions.begin(), guess.dimensions.end());
    if (layout.north_first) std::swap(layout.dimensions[layout.first], layout.dimensions[layout.first + 1]);
    layout.real_colors = guess.real_colors;
    if (guess.intensity) addAttribute(layout, layout.first + *guess.intensity, "intensity", names);
    if (guess.label) addAttribute(layout, layout.first + *guess.label, "label", names);
}

/// The full name of a column: some headers abbreviate intensity to I.
std::string_view fullName(std::string_view name) { return name == "i" || name == "I" ? "intensity" : name; }

/// Named columns without another meaning become attributes if the first point has a number in them.
void nameAttributes(const InputFile& input, Layout& layout, Sink& sink) {
    AttributeNames names;
    std::string unread;
    Fields fields{layout.first_line, layout.delimiter};
    std::string_view field;
    for (std::size_t i = 0; i < layout.names.size(); ++i) {
        const bool is_word = fields.next(field) && !field.empty() && !isAnyNumber(field);
        if (layout.dimensions[i] != kIgnored) continue;
        if (!is_word && addAttribute(layout, i, fullName(layout.names[i]), names)) continue;
        addQuoted(layout.names[i], unread);
    }
    if (!unread.empty()) sink.note(input, "columns of words and columns without a unique name are not read: " + unread);
    if (fields.next(field) && !field.empty())
        sink.note(input, fmt::format("columns from {} on have no name and are not read", layout.names.size() + 1));
}

std::vector<Need> needsOf(const Layout& layout) {
    std::vector<Need> needs;
    for (const Dimension dimension : layout.dimensions)
        needs.push_back(dimension == kIgnored ? Need::kNothing : Need::kNumber);
    for (const std::size_t column : layout.attribute_columns) needs[column] = Need::kNumberOrNot;
    while (needs.back() == Need::kNothing) needs.pop_back();
    return needs;
}

ScanTraits traitsOf(const Layout& layout) {
    ScanTraits traits;
    traits.normals = hasNormals(layout.dimensions);
    traits.colors = hasColors(layout.dimensions);
    traits.faces = false;
    traits.color_scale = layout.real_colors ? ColorScale::kReal : ColorScale::kInteger;
    traits.columns = layout.attributes;
    traits.vertices = layout.data.size() / (layout.first_line.size() + 1) + 1;
    return traits;
}

std::uint64_t addPoints(RowReader& reader, Sink& sink) {
    const Layout& layout = reader.layout;
    std::vector<std::pair<std::size_t, Dimension>> places;
    for (std::size_t i = 0; i < layout.dimensions.size(); ++i)
        if (layout.dimensions[i] != kIgnored) places.emplace_back(i, layout.dimensions[i]);
    std::vector<double> attributes(layout.attributes.size());
    Row row{};
    return forEachRow(reader, [&] {
        for (const auto& [column, dimension] : places) row[dimension] = reader.values[column];
        for (std::size_t i = 0; i < attributes.size(); ++i) attributes[i] = reader.values[layout.attribute_columns[i]];
        sink.addVertex(row, reinterpret_cast<const char*>(attributes.data()));
        return true;
    });
}

void noteWords(const InputFile& input, const Layout& layout, Sink& sink) {
    std::string words;
    for (const std::string_view line : layout.left_out) addQuoted(line, words);
    if (!words.empty()) sink.note(input, "lines of words before the header and below it are not read: " + words);
}

void readTable(const InputFile& input, Sink& sink) {
    Layout layout = readPrologue(input);
    noteWords(input, layout, sink);
    const NumberSurvey numbers = surveyNumbers(layout);
    layout.style = numbers.style();
    if (numbers.isAmbiguous())
        sink.note(input, "has commas before three digits, as in 1,234: they are read as decimal commas");
    if (layout.named())
        nameAttributes(input, layout, sink);
    else
        guessDimensions(input, layout, sink);
    sink.beginScan(input, traitsOf(layout));
    RowReader reader(input, layout, needsOf(layout));
    reader.salvages = sink.salvages;
    const std::uint64_t announced = addPoints(reader, sink);
    if (reader.is_cut) sink.note(input, "its last line is cut short and left out");
    if (announced > sink.vertexCount()) sink.acceptShort(input, sink.vertexCount(), announced);
    if (reader.not_number > 0)
        sink.note(input,
                  fmt::format("{} attribute values are missing or not numbers: they become NaN", reader.not_number));
    if (reader.missing > 0)
        sink.note(input, fmt::format("{} points lack a value: without a coordinate they are left out, without a colour "
                                     "they are black",
                                     reader.missing));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.up_by_custom = true;
    if (layout.isPts() || layout.degrees) sink.setWorldFrame(input, frame);
    if (layout.degrees) sink.addDegrees(input);
    sink.finishScan(input);
}

/// Whether lines end with carriage returns only, as in "CSV (Macintosh)" of spreadsheets.
bool hasOnlyReturns(std::string_view text) {
    return text.find('\n') == text.npos && withoutBlanks(text).find('\r') != text.npos;
}

void readXyz(const InputFile& input, Sink& sink) {
    if (!hasOnlyReturns(input.bytes)) return readTable(input, sink);
    const auto text = std::make_shared<std::string>(input.bytes);
    std::replace(text->begin(), text->end(), '\r', '\n');
    readTable({input.name, *text, text}, sink);
}

} // namespace

const FormatReader readers::kXyz{.read = readXyz, .readsInBatches = alwaysInBatches};

} // namespace pointrt

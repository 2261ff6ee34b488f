// SPDX-License-Identifier: GPL-3.0-or-later
// Point lists as text: a point a line, in columns.
#include <algorithm>
#include <limits>

#include "preprocess/input/formats.h"
#include "preprocess/input/table.h"
#include "preprocess/input/xyz_columns.h"
#include "preprocess/input/xyz_layout.h"

namespace pointrt {
namespace {

/// What a line must have in a column.
enum class Need { kNothing, kNumber, kNumberOrNot };

struct RowReader {
    const Source& source;
    const Layout& layout;
    std::vector<Need> needs; ///< one per column, up to the last that is read
    std::vector<double> values;
    std::size_t needed = 0;       ///< columns up to the last number that must be there
    std::uint64_t not_number = 0; ///< values so far that might have been numbers

    RowReader(const Source& from, const Layout& how, std::vector<Need> what)
        : source(from), layout(how), needs(std::move(what)), values(needs.size()) {
        for (std::size_t i = 0; i < needs.size(); ++i)
            if (needs[i] == Need::kNumber) needed = i + 1;
    }

    /// Parses one line into values. Throws Error when a number that must be there is missing or none.
    void parse(std::string_view line) {
        Fields fields{line, layout.delimiter};
        std::string_view field;
        for (std::size_t i = 0; i < needs.size(); ++i) {
            const bool there = fields.next(field);
            if (!there && i < needed)
                refuseLine(source, line.data(), fmt::format("has {} columns, {} are needed", i, needed));
            if (needs[i] == Need::kNothing || (there && wholeNumber(field, values[i]))) continue;
            if (needs[i] == Need::kNumber)
                refuseLine(source, line.data(),
                           fmt::format("column {} is no number: {}{}", i + 1, inQuotes(field), commaHint(line)));
            values[i] = std::numeric_limits<double>::quiet_NaN();
            ++not_number;
        }
    }
};

/// Calls use() for each point, its values being in the reader. Returns how many points the count lines announce, none
/// if there are none.
template <typename Use>
std::uint64_t forEachRow(RowReader& reader, Use&& use) {
    const Layout& layout = reader.layout;
    std::uint64_t announced = layout.counted_points;
    std::string_view rest = layout.data, line;
    LetGoBehind let_go{reader.source};
    while (nextLine(rest, line)) {
        let_go(static_cast<std::uint64_t>(line.data() - reader.source.begin()));
        const std::string_view trimmed = withoutBlanks(line);
        if (trimmed.empty() || commentText(trimmed)) continue;
        std::uint64_t count = 0;
        if (layout.counted && wholeInteger(trimmed, count)) {
            if (__builtin_add_overflow(announced, count, &announced))
                refuseLine(reader.source, line.data(), "impossible count");
            continue;
        }
        reader.parse(trimmed);
        use();
    }
    return announced;
}

/// Columns without a header are told by their values, in a pass of its own.
void guessRoles(const Source& source, Layout& layout, Sink& sink) {
    const std::size_t extras = layout.columns - 3;
    ColumnStatistics statistics;
    RowReader reader(source, layout, std::vector<Need>(layout.columns, Need::kNumber));
    if (extras > 1 && extras <= ColumnStatistics::kMax)
        forEachRow(reader, [&] { observe(statistics, reader.values.data() + 3, extras); });
    ColumnGuess guess = guessColumns(statistics, layout.columns, layout.counted);
    if (!guess.doubt.empty()) addNote(sink.cloud, source.name, guess.doubt);
    layout.roles = std::move(guess.roles);
    layout.real_colors = guess.real_colors;
    AttributeNames names;
    if (guess.intensity) addAttribute(layout, *guess.intensity, "intensity", names);
}

/// What a header calls a column: lists say I where others write the word out.
std::string_view writtenName(std::string_view name) { return name == "i" || name == "I" ? "intensity" : name; }

/// Columns that a header names, and that are nothing else, are attributes where the first point has numbers there.
void nameAttributes(const Source& source, Layout& layout, Sink& sink) {
    AttributeNames names;
    std::string unread;
    Fields fields{layout.first_line, layout.delimiter};
    std::string_view field;
    for (std::size_t i = 0; i < layout.names.size(); ++i) {
        double value = 0;
        const bool is_word = fields.next(field) && !field.empty() && !wholeNumber(field, value);
        if (layout.roles[i] != kIgnored) continue;
        if (!is_word && addAttribute(layout, i, writtenName(layout.names[i]), names)) continue;
        if (unread.size() < 80) unread += (unread.empty() ? "" : ", ") + inQuotes(layout.names[i]); // a line's worth
    }
    if (!unread.empty())
        addNote(sink.cloud, source.name,
                "columns that hold words, or whose name is none or another's, are not read: " + unread);
    if (fields.next(field))
        addNote(sink.cloud, source.name,
                fmt::format("columns from {} on have no name and are not read", layout.names.size() + 1));
}

std::vector<Need> needsOf(const Layout& layout) {
    std::vector<Need> needs;
    for (const Role role : layout.roles) needs.push_back(role == kIgnored ? Need::kNothing : Need::kNumber);
    for (const std::size_t column : layout.attribute_columns) needs[column] = Need::kNumberOrNot;
    while (needs.back() == Need::kNothing) needs.pop_back();
    return needs;
}

ScanTraits traitsOf(const Layout& layout) {
    ScanTraits traits;
    traits.normals = hasNormals(layout.roles);
    traits.colors = hasColors(layout.roles);
    traits.faces = false;
    traits.color_scale = layout.real_colors ? ColorScale::kReal : ColorScale::kInteger;
    traits.columns = layout.attributes;
    traits.vertices = layout.data.size() / (layout.first_line.size() + 1) + 1;
    return traits;
}

std::uint64_t addPoints(RowReader& reader, Sink& sink) {
    const Layout& layout = reader.layout;
    std::vector<std::pair<std::size_t, Role>> places;
    for (std::size_t i = 0; i < layout.roles.size(); ++i)
        if (layout.roles[i] != kIgnored) places.emplace_back(i, layout.roles[i]);
    std::vector<double> attributes(layout.attributes.size());
    Row row{};
    return forEachRow(reader, [&] {
        for (const auto& [column, role] : places) row[role] = reader.values[column];
        for (std::size_t i = 0; i < attributes.size(); ++i) attributes[i] = reader.values[layout.attribute_columns[i]];
        addVertex(sink, row, reinterpret_cast<const char*>(attributes.data()));
    });
}

void readXyz(const Source& source, Sink& sink) {
    Layout layout = readPrologue(source);
    if (layout.named())
        nameAttributes(source, layout, sink);
    else
        guessRoles(source, layout, sink);
    beginScan(sink, source, traitsOf(layout));
    RowReader reader(source, layout, needsOf(layout));
    const std::uint64_t announced = addPoints(reader, sink);
    if (announced > sink.vertices)
        refuse(source, fmt::format("cut short: {} of {} points are there", sink.vertices, announced));
    if (reader.not_number > 0)
        addNote(sink.cloud, source.name,
                fmt::format("{} values of its attributes are missing or no numbers: NaN stands for them",
                            reader.not_number));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    if (layout.isPts()) setWorldFrame(sink, source, frame);
    finishScan(sink, source);
}

} // namespace

const FormatReader readers::kXyz{.read = readXyz, .readsInBatches = alwaysInBatches};

} // namespace pointrt

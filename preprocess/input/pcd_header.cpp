// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/pcd_header.h"

#include <algorithm>
#include <array>

#include "preprocess/input/attribute_names.h"
#include "preprocess/input/text.h"

namespace pointrt {
namespace {

/// The lines of a header before they are put together.
struct Entries {
    std::vector<PcdField> fields;
    std::optional<std::uint64_t> width, height, points;
    std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0}; ///< translation, quaternion w x y z
};

std::uint64_t integer(const Source& source, std::string_view word, std::string_view keyword) {
    std::uint64_t value = 0;
    if (!wholeInteger(word, value))
        refuseLine(source, word.data(), fmt::format("{} takes whole numbers, not {}", keyword, inQuotes(word)));
    return value;
}

/// Calls set(field, word) for each word of a line that has one per field.
template <typename Set>
void setFields(const Source& source, std::string_view line, std::string_view keyword, Entries& entries, Set&& set) {
    const char* const place = line.data();
    for (PcdField& field : entries.fields) {
        const std::string_view word = nextWord(line);
        if (word.empty()) refuseLine(source, place, fmt::format("{} has fewer entries than FIELDS", keyword));
        set(field, word);
    }
}

void setNames(std::string_view line, Entries& entries) {
    entries.fields.clear();
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line)) {
        PcdField field;
        field.name = word;
        entries.fields.push_back(field);
    }
}

void setViewpoint(const Source& source, std::string_view line, Entries& entries) {
    const char* const place = line.data();
    for (double& value : entries.viewpoint)
        if (!wholeNumber(nextWord(line), value)) refuseLine(source, place, "VIEWPOINT takes 7 numbers");
}

PcdData dataOf(const Source& source, std::string_view word) {
    if (word == "ascii") return PcdData::kAscii;
    if (word == "binary") return PcdData::kBinary;
    if (word == "binary_compressed") return PcdData::kCompressed;
    refuseLine(source, word.data(), fmt::format("unknown DATA {}", inQuotes(word)));
}

void parseEntry(const Source& source, std::string_view keyword, std::string_view line, Entries& entries) {
    std::string_view rest = line;
    if (keyword == "FIELDS" || keyword == "COLUMNS")
        setNames(line, entries);
    else if (keyword == "SIZE")
        setFields(source, line, keyword, entries,
                  [&](PcdField& field, std::string_view word) { field.size = integer(source, word, keyword); });
    else if (keyword == "TYPE")
        setFields(source, line, keyword, entries,
                  [](PcdField& field, std::string_view word) { field.type = word.size() == 1 ? word[0] : '?'; });
    else if (keyword == "COUNT")
        setFields(source, line, keyword, entries,
                  [&](PcdField& field, std::string_view word) { field.count = integer(source, word, keyword); });
    else if (keyword == "WIDTH")
        entries.width = integer(source, nextWord(rest), keyword);
    else if (keyword == "HEIGHT")
        entries.height = integer(source, nextWord(rest), keyword);
    else if (keyword == "POINTS")
        entries.points = integer(source, nextWord(rest), keyword);
    else if (keyword == "VIEWPOINT")
        setViewpoint(source, line, entries);
}

std::optional<Scalar> scalarOf(char type, std::size_t size) {
    if (size != 1 && size != 2 && size != 4 && size != 8) return std::nullopt;
    const int step = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : 3;
    constexpr Scalar kSigned[] = {Scalar::kI8, Scalar::kI16, Scalar::kI32, Scalar::kI64};
    constexpr Scalar kUnsigned[] = {Scalar::kU8, Scalar::kU16, Scalar::kU32, Scalar::kU64};
    if (type == 'I') return kSigned[step];
    if (type == 'U') return kUnsigned[step];
    if (type == 'F' && size >= 4) return size == 4 ? Scalar::kF32 : Scalar::kF64;
    return std::nullopt;
}

void settleField(const Source& source, PcdField& field) {
    // Wide enough for any histogram, small enough that sums stay far from overflow.
    constexpr std::uint64_t kLargestCount = 1u << 24;
    const auto scalar = scalarOf(field.type, field.size);
    if (!scalar)
        refuse(source, fmt::format("field {} has type {} of {} bytes, which PCD does not know", inQuotes(field.name),
                                   inQuotes({&field.type, 1}), field.size));
    if (field.count < 1 || field.count > kLargestCount)
        refuse(source, fmt::format("field {} has an impossible COUNT of {}", inQuotes(field.name), field.count));
    field.scalar = *scalar;
    field.packed_color = (field.name == "rgb" || field.name == "rgba") && field.size == 4 && field.count == 1;
}

void settleFields(const Source& source, PcdHeader& header) {
    constexpr std::size_t kMaxFields = 1 << 16;
    if (header.fields.size() > kMaxFields) refuse(source, "more than 65536 fields");
    std::vector<Role> roles;
    for (PcdField& field : header.fields) {
        settleField(source, field);
        roles.push_back(field.count == 1 ? roleOfName(field.name) : kIgnored);
        header.point_size += field.size * field.count;
    }
    settleRoles(roles);
    if (!hasPositions(roles))
        refuse(source, header.fields.empty() ? "no PCD header with FIELDS" : "FIELDS has no x, y and z");
    for (std::size_t i = 0; i < roles.size(); ++i) header.fields[i].role = roles[i];
}

/// Numbers of 1 to 4 that are nothing else are attributes; "_" stands for room left free.
void settleAttributes(PcdHeader& header) {
    constexpr std::uint64_t kMostComponents = 4;
    AttributeNames names;
    for (PcdField& field : header.fields) {
        if (field.role != kIgnored || field.packed_color || field.name == "_") continue;
        const auto name = field.count <= kMostComponents ? names.take(field.name) : std::nullopt;
        if (name) {
            field.place = header.packed_size;
            header.columns.push_back({*name, field.scalar, static_cast<std::uint32_t>(field.count)});
            header.packed_size += field.size * field.count;
        } else if (header.unread.size() < 80) { // a line's worth
            header.unread += (header.unread.empty() ? "" : ", ") + inQuotes(field.name);
        }
    }
}

std::uint64_t pointCount(const Source& source, const Entries& entries) {
    const std::uint64_t height = entries.height.value_or(1);
    if (!entries.width && !entries.points) refuse(source, "the PCD header has neither WIDTH nor POINTS");
    if (!entries.width) return *entries.points;
    std::uint64_t cells = 0;
    const bool overflow = __builtin_mul_overflow(*entries.width, height, &cells);
    if (overflow || (entries.points && *entries.points != cells))
        refuse(source, fmt::format("WIDTH {} times HEIGHT {} is not POINTS {}", *entries.width, height,
                                   entries.points.value_or(0)));
    return cells;
}

/// The default viewpoint of an unorganised cloud means nothing; that of an organised one is its camera.
std::optional<Vec3d> sensorOf(const Entries& entries) {
    const bool organised = entries.height.value_or(1) > 1;
    const bool by_default = entries.viewpoint == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0};
    if (by_default && !organised) return std::nullopt;
    return Vec3d(entries.viewpoint[0], entries.viewpoint[1], entries.viewpoint[2]);
}

} // namespace

PcdHeader readPcdHeader(const Source& source) {
    PcdHeader header;
    Entries entries;
    std::string_view rest = source.bytes, line;
    while (nextLine(rest, line)) {
        const std::string_view keyword = nextWord(line);
        if (keyword != "DATA") {
            parseEntry(source, keyword, line, entries);
            continue;
        }
        header.data = dataOf(source, nextWord(line));
        header.body = rest;
        header.fields = std::move(entries.fields);
        settleFields(source, header);
        settleAttributes(header);
        header.points = pointCount(source, entries);
        header.grid_rows = entries.width ? entries.height.value_or(1) : 1;
        header.grid_columns = entries.width.value_or(header.points);
        header.sensor = sensorOf(entries);
        return header;
    }
    refuse(source, "no PCD header: there is no DATA line");
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/pcd_header.h"

#include <algorithm>
#include <array>

#include "preprocess/ingest/attribute_names.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

/// The entries of a header, before they are combined into fields.
struct Entries {
    std::vector<PcdField> fields;
    std::optional<std::uint64_t> width, height, points;
    std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0}; ///< translation, quaternion w x y z
};

std::uint64_t integer(const InputFile& input, std::string_view word, std::string_view keyword) {
    std::uint64_t value = 0;
    if (!wholeInteger(word, value))
        refuseLine(input, word.data(), fmt::format("{} takes whole numbers, not {}", keyword, inQuotes(word)));
    return value;
}

/// Calls set(field, word) for each word of a line with one word per field.
template <typename Set>
void setFields(const InputFile& input, std::string_view line, std::string_view keyword, Entries& entries, Set&& set) {
    const char* const place = line.data();
    for (PcdField& field : entries.fields) {
        const std::string_view word = nextWord(line);
        if (word.empty()) refuseLine(input, place, fmt::format("{} has fewer entries than FIELDS", keyword));
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

void setViewpoint(const InputFile& input, std::string_view line, Entries& entries) {
    const char* const place = line.data();
    for (double& value : entries.viewpoint)
        if (!wholeNumber(nextWord(line), value)) refuseLine(input, place, "VIEWPOINT needs 7 numbers");
}

PcdData dataOf(const InputFile& input, std::string_view word) {
    if (word == "ascii") return PcdData::kAscii;
    if (word == "binary") return PcdData::kBinary;
    if (word == "binary_compressed") return PcdData::kCompressed;
    refuseLine(input, word.data(), fmt::format("unknown DATA {}", inQuotes(word)));
}

void parseEntry(const InputFile& input, std::string_view keyword, std::string_view line, Entries& entries) {
    std::string_view rest = line;
    if (keyword == "FIELDS" || keyword == "COLUMNS")
        setNames(line, entries);
    else if (keyword == "SIZE")
        setFields(input, line, keyword, entries,
                  [&](PcdField& field, std::string_view word) { field.size = integer(input, word, keyword); });
    else if (keyword == "TYPE")
        setFields(input, line, keyword, entries,
                  [](PcdField& field, std::string_view word) { field.type = word.size() == 1 ? word[0] : '?'; });
    else if (keyword == "COUNT")
        setFields(input, line, keyword, entries,
                  [&](PcdField& field, std::string_view word) { field.count = integer(input, word, keyword); });
    else if (keyword == "WIDTH")
        entries.width = integer(input, nextWord(rest), keyword);
    else if (keyword == "HEIGHT")
        entries.height = integer(input, nextWord(rest), keyword);
    else if (keyword == "POINTS")
        entries.points = integer(input, nextWord(rest), keyword);
    else if (keyword == "VIEWPOINT")
        setViewpoint(input, line, entries);
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

void settleField(const InputFile& input, PcdField& field) {
    // Large enough for any histogram, small enough that sums cannot overflow.
    constexpr std::uint64_t kLargestCount = 1u << 24;
    const auto scalar = scalarOf(field.type, field.size);
    if (!scalar)
        refuse(input, fmt::format("field {} has type {} of {} bytes, which is not a PCD type", inQuotes(field.name),
                                  inQuotes({&field.type, 1}), field.size));
    // fields with a count of 0 are padding without bytes, which drivers of lidars write
    if (field.count > kLargestCount)
        refuse(input, fmt::format("field {} has an impossible COUNT of {}", inQuotes(field.name), field.count));
    field.scalar = *scalar;
    field.packed_color = (field.name == "rgb" || field.name == "rgba") && field.size == 4 && field.count == 1;
}

void settleFields(const InputFile& input, PcdHeader& header) {
    constexpr std::size_t kMaxFields = 1 << 16;
    if (header.fields.size() > kMaxFields) refuse(input, "more than 65536 fields");
    std::vector<Dimension> dimensions;
    for (PcdField& field : header.fields) {
        settleField(input, field);
        dimensions.push_back(field.count == 1 ? dimensionOfName(field.name) : kIgnored);
        header.point_size += field.size * field.count;
    }
    resolveDimensions(dimensions);
    if (!hasPositions(dimensions))
        refuse(input, header.fields.empty() ? "no PCD header with FIELDS" : "FIELDS has no x, y and z");
    for (std::size_t i = 0; i < dimensions.size(); ++i) header.fields[i].dimension = dimensions[i];
}

/// Fields of 1 to 4 numbers without another meaning become attributes; "_" is padding.
void settleAttributes(PcdHeader& header) {
    constexpr std::uint64_t kMostComponents = 4;
    AttributeNames names;
    for (PcdField& field : header.fields) {
        if (field.dimension != kIgnored || field.packed_color || field.name == "_" || field.count == 0) continue;
        const auto name = field.count <= kMostComponents ? names.take(field.name) : std::nullopt;
        if (name) {
            field.place = header.packed_size;
            header.columns.push_back({*name, field.scalar, static_cast<std::uint32_t>(field.count)});
            header.packed_size += field.size * field.count;
        } else {
            addQuoted(field.name, header.unread);
        }
    }
}

std::uint64_t pointCount(const InputFile& input, const Entries& entries) {
    const std::uint64_t height = entries.height.value_or(1);
    if (!entries.width && !entries.points) refuse(input, "the PCD header has neither WIDTH nor POINTS");
    if (!entries.width) return *entries.points;
    std::uint64_t cells = 0;
    const bool overflow = __builtin_mul_overflow(*entries.width, height, &cells);
    if (overflow || (entries.points && *entries.points != cells))
        refuse(input, fmt::format("WIDTH {} times HEIGHT {} differs from POINTS {}", *entries.width, height,
                                  entries.points.value_or(0)));
    return cells;
}

/// The default viewpoint of an unorganised cloud is meaningless; that of an organised one is its camera.
std::optional<Vec3d> sensorOf(const Entries& entries) {
    const bool organised = entries.height.value_or(1) > 1;
    const bool by_default = entries.viewpoint == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0};
    if (by_default && !organised) return std::nullopt;
    return Vec3d(entries.viewpoint[0], entries.viewpoint[1], entries.viewpoint[2]);
}

} // namespace

PcdHeader readPcdHeader(const InputFile& input) {
    PcdHeader header;
    Entries entries;
    std::string_view rest = input.bytes, line;
    while (nextLine(rest, line)) {
        const std::string_view keyword = nextWord(line);
        if (keyword != "DATA") {
            parseEntry(input, keyword, line, entries);
            continue;
        }
        header.data = dataOf(input, nextWord(line));
        header.body = rest;
        header.fields = std::move(entries.fields);
        settleFields(input, header);
        settleAttributes(header);
        header.points = pointCount(input, entries);
        header.grid_rows = entries.width ? entries.height.value_or(1) : 1;
        header.grid_columns = entries.width.value_or(header.points);
        header.sensor = sensorOf(entries);
        return header;
    }
    refuse(input, "no PCD header: there is no DATA line");
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of NumPy: a .npy of points, or the arrays of a .npz that belong together.
#include <algorithm>
#include <cmath>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/zip.h"
#include "preprocess/input/points/npy_header.h"

namespace pointrt {
namespace {

/// Rows of points, columns of values: how a plain array is read.
struct NpyTable {
    std::uint64_t rows = 0, columns = 0, present = 0;
    FieldArray column; ///< the first
    std::size_t step = 0;

    FieldArray at(std::uint64_t index, std::string name, Dimension dimension = kIgnored,
                  std::uint32_t count = 1) const {
        FieldArray field = column;
        field.name = std::move(name);
        field.first += index * step;
        field.step = step;
        field.components = count;
        field.dimension = dimension;
        return field;
    }
    double value(std::uint64_t row, std::uint64_t index) const {
        return loadScalar(column.first + row * column.stride + index * step, column.type, column.swapped);
    }
};

/// Further columns are features for a neural network rather than values of points.
constexpr std::uint64_t kMostNpyColumns = 64;

/// A table of at least three columns; none if the shape does not fit points. Rows come first, in any number of
/// dimensions (a picture of points, a batch of clouds), unless there are few of them and many columns.
std::optional<NpyTable> tableOf(const NpyArray& array) {
    const std::vector<std::uint64_t>& shape = array.shape;
    if (shape.size() < 2 || array.elements == 0) return std::nullopt;
    const bool turned = shape.size() == 2 && shape[1] > kMostNpyColumns && shape[0] >= 3 && shape[0] <= kMostNpyColumns;
    NpyTable table;
    table.columns = turned ? shape[0] : shape.back();
    table.rows = array.elements / table.columns;
    if (table.columns < 3 || table.columns > kMostNpyColumns) return std::nullopt;
    // a transposed array in Fortran order, or a table in C order, stores a point's values side by side
    const bool by_point = turned == array.fortran_order;
    if (!by_point && shape.size() > 2) return std::nullopt; // the rows are not evenly spaced
    table.column = array.fields.front();
    const std::size_t size = table.column.stride;
    table.step = by_point ? size : size * table.rows;
    table.column.stride = by_point ? size * table.columns : size;
    table.present = by_point ? array.present / table.columns : array.present < array.elements ? 0 : table.rows;
    return table;
}

enum class Triple { kNormals, kColors, kOther };

/// The content of three columns: unit vectors, colours in [0, 1] or [0, 255], or something else.
Triple tripleAt(const NpyTable& table, std::uint64_t first) {
    constexpr std::uint64_t kTested = 4096;
    constexpr double kUnit = 1e-3; // tolerance for half floats and rounded texts
    const std::uint64_t tested = std::min(table.present, kTested),
                        every = std::max<std::uint64_t>(1, table.present / kTested);
    std::uint64_t units = 0, colors = 0, set = 0;
    for (std::uint64_t i = 0; i < tested; ++i) {
        const Vec3d values(table.value(i * every, first), table.value(i * every, first + 1),
                           table.value(i * every, first + 2));
        units += std::abs(values.norm() - 1) < kUnit;
        colors += values.minCoeff() >= 0 && values.maxCoeff() <= 255;
        set += !values.isZero(0);
    }
    if (set > 0 && units >= set && isReal(table.column.type)) return Triple::kNormals;
    return colors == tested && set > 0 ? Triple::kColors : Triple::kOther;
}

/// Takes colours or normals at columns `at` to `at` + 2 if the values look like them and none were taken before.
bool takeTriple(const NpyTable& table, std::uint64_t at, std::vector<FieldArray>& fields, std::string& read_as) {
    if (at + 3 > table.columns) return false;
    const Triple triple = tripleAt(table, at);
    const bool normals = triple == Triple::kNormals;
    const Dimension dimension = normals ? kNormalX : kRed;
    const bool taken = std::any_of(fields.begin(), fields.end(),
                                   [&](const FieldArray& field) { return field.dimension == dimension; });
    if (triple == Triple::kOther || taken) return false;
    fields.push_back(table.at(at, normals ? "normals" : "colors", dimension, 3));
    read_as += fmt::format(", {} to {} as {}", at + 1, at + 3, normals ? "normals" : "colours");
    return true;
}

/// The columns of a table without names. `read_as` describes them.
std::vector<FieldArray> fieldsOf(const NpyTable& table, std::string& read_as) {
    std::vector<FieldArray> fields{table.at(0, "points", kX, 3)};
    std::uint64_t at = 3;
    // x y z intensity, as KITTI and its successors have it, perhaps with a ring or a time
    const bool has_intensity = table.columns == 4 || table.columns == 5 || table.columns == 7;
    if (has_intensity && !takeTriple(table, at, fields, read_as)) {
        fields.push_back(table.at(at, "intensity"));
        read_as += fmt::format(", {} as intensity", ++at);
    } else if (has_intensity) {
        at += 3;
    }
    while (at < table.columns) {
        if (takeTriple(table, at, fields, read_as)) {
            at += 3;
            continue;
        }
        fields.push_back(table.at(at, fmt::format("column_{}", at + 1)));
        ++at;
    }
    return fields;
}

[[noreturn]] void refuseShape(const InputFile& input, const NpyArray& array) {
    std::string shape;
    for (const std::uint64_t length : array.shape) shape += fmt::format("{}{}", shape.empty() ? "" : ", ", length);
    refuse(input, fmt::format("has an array of shape ({}); points are rows of 3 to {} columns, x, y and z first", shape,
                              kMostNpyColumns));
}

void addArrays(const InputFile& input, std::vector<FieldArray>& fields, std::uint64_t present, std::uint64_t points,
               Sink& sink) {
    if (present < points) sink.acceptShort(input, present, points);
    addFieldPoints(input, fields, present, sink);
    sink.finishScan(input);
}

void readRecords(const InputFile& input, NpyArray& array, Sink& sink) {
    findDimensions(array.fields);
    if (!hasPositions(array.fields)) refuse(input, "has no fields named x, y and z, or points");
    addArrays(input, array.fields, array.present, array.elements, sink);
}

void readArray(const InputFile& input, Sink& sink) {
    NpyArray array = readNpyHeader(input);
    if (!array.isPlain()) return readRecords(input, array, sink);
    const auto table = tableOf(array);
    if (!table) refuseShape(input, array);
    std::string read_as;
    std::vector<FieldArray> fields = fieldsOf(*table, read_as);
    if (!read_as.empty()) sink.note(input, "has columns without names: 1 to 3 are read as x, y and z" + read_as);
    addArrays(input, fields, table->present, table->rows, sink);
}

/// An array of an archive.
struct NamedArray {
    std::string name;
    InputFile file;
    NpyArray array;
};

bool isArrayName(std::string_view name) { return name.ends_with(".npy"); }

std::vector<NamedArray> arraysOf(const InputFile& input, Sink& sink) {
    const auto members = zipMembers(input.bytes);
    if (!members) refuse(input, "the zip archive is truncated or invalid");
    std::vector<NamedArray> arrays;
    for (const ZipMember& member : *members) {
        if (!isArrayName(member.name)) continue;
        NamedArray array{std::string(member.name.substr(0, member.name.size() - 4)), openZipMember(input, member), {}};
        try {
            array.array = readNpyHeader(array.file);
        } catch (const Error& error) { // other arrays are texts and objects
            sink.note(input, fmt::format("array {} is not read: {}", inQuotes(array.name), error.what()));
            continue;
        }
        arrays.push_back(std::move(array));
    }
    return arrays;
}

/// The fields of an array with a value for each of `points` points; none if it is something else.
std::optional<FieldArray> fieldFor(const NamedArray& each, std::uint64_t points) {
    if (!each.array.isPlain() || each.array.present < each.array.elements || points == 0) return std::nullopt;
    const std::vector<std::uint64_t>& shape = each.array.shape;
    const bool is_column = shape.size() == 1 || (shape.size() == 2 && shape[1] == 1);
    FieldArray field = each.array.fields.front();
    field.name = each.name;
    if (is_column) return each.array.elements == points ? std::optional(field) : std::nullopt;
    if (shape.size() == 2 && shape[1] == 2 && shape[0] == points) {
        const std::size_t size = field.stride;
        field.components = 2;
        field.step = each.array.fortran_order ? size * points : size;
        field.stride = each.array.fortran_order ? size : 2 * size;
        return field;
    }
    const auto table = tableOf(each.array);
    if (!table || table->rows != points) return std::nullopt;
    return table->at(0, each.name, kIgnored, static_cast<std::uint32_t>(table->columns));
}

/// The number of points: that of the array with a telling name, or of x.
std::uint64_t pointsOf(const std::vector<NamedArray>& arrays) {
    for (const NamedArray& each : arrays) {
        const auto table = each.array.isPlain() ? tableOf(each.array) : std::nullopt;
        FieldArray field;
        field.name = each.name;
        field.components = table ? 3 : 1;
        findDimensions({&field, 1});
        if (field.dimension == kX && table) return table->rows;
        if (dimensionOfName(each.name) == kX) return each.array.elements;
    }
    return 0;
}

/// The only array that can hold points, or one of records.
const NamedArray* soleArray(const std::vector<NamedArray>& arrays) {
    const NamedArray* sole = nullptr;
    for (const NamedArray& each : arrays) {
        if (each.array.isPlain() && !tableOf(each.array)) continue;
        if (sole) return nullptr;
        sole = &each;
    }
    return sole;
}

std::string namesOf(const std::vector<NamedArray>& arrays) {
    std::string names;
    for (const NamedArray& each : arrays) addQuoted(each.name, names);
    return names;
}

void readArchive(const InputFile& input, Sink& sink) {
    const std::vector<NamedArray> arrays = arraysOf(input, sink);
    const std::uint64_t points = pointsOf(arrays);
    std::vector<FieldArray> fields;
    std::string unread;
    for (const NamedArray& each : arrays) {
        const auto field = fieldFor(each, points);
        if (field)
            fields.push_back(*field);
        else
            addQuoted(each.name, unread);
    }
    findDimensions(fields);
    if (!hasPositions(fields)) {
        const NamedArray* const sole = soleArray(arrays);
        if (!sole)
            refuse(input, fmt::format("none of its arrays is named points, xyz or positions: it has {}",
                                      arrays.empty() ? "none" : namesOf(arrays)));
        return readArray(sole->file, sink);
    }
    if (!unread.empty()) sink.note(input, "arrays without a value for each point are not read: " + unread);
    addFieldPoints(input, fields, points, sink);
    sink.finishScan(input);
}

bool isNumPyStart(std::string_view bytes) {
    return isNpy(bytes) || (isZip(bytes) && isArrayName(firstZipMember(bytes)));
}

void readNumPy(const InputFile& input, Sink& sink) {
    if (isZip(input.bytes)) return readArchive(input, sink);
    readArray(input, sink);
}

} // namespace

const FormatReader readers::kNumPy{.isStart = isNumPyStart, .read = readNumPy, .readsInBatches = alwaysInBatches};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// PTX: Leica's text format of structured scans, each with its grid, scanner position and transform.
#include <algorithm>
#include <cmath>
#include <optional>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

/// The numbers of a line; nullopt if it has other words or another count.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbersOf(std::string_view line) {
    std::array<double, kCount> numbers;
    for (double& number : numbers)
        if (!wholeNumber(nextWord(line), number)) return std::nullopt;
    return nextWord(line).empty() ? std::optional(numbers) : std::nullopt;
}

std::optional<std::uint64_t> countOf(std::string_view line) {
    std::uint64_t count = 0;
    const bool is_count = wholeInteger(nextWord(line), count) && nextWord(line).empty();
    return is_count ? std::optional(count) : std::nullopt;
}

struct PtxHeader {
    std::uint64_t columns = 0, rows = 0, cells = 0;
    Vec3d position = Vec3d::Zero(); ///< of the scanner, after registration
    Pose input_from_scan;
};

/// Two counts, four lines of three numbers and four of four: no point list starts like that.
bool isPtxStart(std::string_view bytes) {
    Lines lines{bytes.substr(0, 4096)}; // enough for ten lines of numbers
    std::string_view line;
    for (int i = 0; i < 2; ++i)
        if (!lines.next(line) || !countOf(line)) return false;
    for (int i = 0; i < 4; ++i)
        if (!lines.next(line) || !numbersOf<3>(line)) return false;
    for (int i = 0; i < 4; ++i)
        if (!lines.next(line) || !numbersOf<4>(line)) return false;
    return true;
}

std::string_view headerLine(const InputFile& input, Lines& lines) {
    std::string_view line;
    if (!lines.next(line)) refuse(input, "truncated in the header of a scan");
    return line;
}

std::uint64_t readCount(const InputFile& input, std::string_view line, const char* what) {
    const auto count = countOf(line);
    if (!count) refuseLine(input, line.data(), fmt::format("expected the number of {}, not {}", what, inQuotes(line)));
    return *count;
}

template <std::size_t kCount>
std::array<double, kCount> readNumbers(const InputFile& input, Lines& lines, const char* what) {
    const std::string_view line = headerLine(input, lines);
    const auto numbers = numbersOf<kCount>(line);
    if (!numbers) refuseLine(input, line.data(), fmt::format("expected {} numbers for {}", kCount, what));
    return *numbers;
}

/// The matrix multiplies row vectors: input = (x, y, z, 1) * matrix.
void readTransform(const InputFile& input, Lines& lines, Pose& input_from_scan) {
    const char* const place = lines.rest.data();
    bool affine = true;
    for (int row = 0; row < 4; ++row) {
        const auto numbers = readNumbers<4>(input, lines, "a line of the transform");
        const Vec3d values(numbers[0], numbers[1], numbers[2]);
        if (row < 3)
            input_from_scan.linear.col(row) = values;
        else
            input_from_scan.translation = values;
        affine = affine && numbers[3] == (row < 3 ? 0 : 1);
    }
    const double determinant = input_from_scan.linear.determinant();
    constexpr double kFlat = 1e-12; // the determinant of a rotation is 1
    if (!affine || !(std::abs(determinant) > kFlat) || !std::isfinite(determinant) ||
        !input_from_scan.translation.allFinite())
        refuseLine(input, place, "the transform is not a rotation and translation");
}

/// Reads every line of the header. If the file is salvaged, its cells may be missing.
PtxHeader readHeader(const InputFile& input, std::string_view first_line, bool salvages, Lines& lines) {
    PtxHeader header;
    header.columns = readCount(input, first_line, "columns");
    header.rows = readCount(input, headerLine(input, lines), "rows");
    const auto position = readNumbers<3>(input, lines, "the position of the scanner");
    header.position = {position[0], position[1], position[2]};
    for (int axis = 0; axis < 3; ++axis) readNumbers<3>(input, lines, "an axis of the scanner");
    readTransform(input, lines, header.input_from_scan);
    // A cell takes at least six bytes, "0 0 0" and a line end; the last one needs no line end.
    const std::uint64_t most = (lines.rest.size() + 1) / 6;
    const bool overflows = __builtin_mul_overflow(header.columns, header.rows, &header.cells);
    if (overflows || (header.cells > most && !salvages))
        refuseLine(input, first_line.data(),
                   fmt::format("the header promises {} columns of {} points, but only {} bytes follow; --salvage reads "
                               "the intact part",
                               header.columns, header.rows, lines.rest.size()));
    return header;
}

/// The values that the points of a scan have, detected from the first point.
struct Shape {
    std::size_t words = 3;
    bool intensity = false, colors = false, real_colors = false;
};

bool isMissing(std::string_view line) {
    double value = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (!wholeNumber(nextWord(line), value) || value != 0) return false;
    return true;
}

/// The line of the first cell with a point, else of the last cell: missing points may be written with fewer words.
std::string_view firstPointLine(Lines lines, std::uint64_t cells) {
    std::string_view line;
    for (std::uint64_t i = 0; i < cells && lines.next(line); ++i)
        if (!isMissing(line)) break;
    return line;
}

Shape shapeOf(const InputFile& input, const Lines& lines, std::uint64_t cells) {
    Shape shape;
    const std::string_view line = firstPointLine(lines, cells);
    if (line.empty()) return shape;
    std::string_view words = line, word;
    for (shape.words = 0; !(word = nextWord(words)).empty(); ++shape.words)
        shape.real_colors |= shape.words > 3 && word.find('.') != std::string_view::npos;
    shape.intensity = shape.words == 4 || shape.words == 7;
    shape.colors = shape.words >= 6;
    if (shape.words != 3 && !shape.intensity && shape.words != 6)
        refuseLine(input, line.data(), fmt::format("a point has 3, 4, 6 or 7 numbers, not {}", shape.words));
    return shape;
}

/// A cell's attribute values, packed.
struct PackedCell {
    float intensity = 0; ///< written with six decimals, which a float holds
    std::uint32_t row = 0, column = 0;
};
static_assert(sizeof(PackedCell) == 12);

/// most_cells: number of cells that fit in the file
ScanTraits traitsOf(const PtxHeader& header, const Shape& shape, std::uint64_t most_cells) {
    ScanTraits traits;
    traits.vertices = std::min(header.cells, most_cells);
    traits.faces = false;
    traits.colors = shape.colors;
    traits.color_scale = shape.real_colors ? ColorScale::kReal : ColorScale::kInteger;
    if (shape.intensity) traits.columns.push_back({"intensity", Scalar::kF32});
    traits.columns.push_back({"row", Scalar::kU32, 1, true});
    traits.columns.push_back({"column", Scalar::kU32, 1, true});
    return traits;
}

/// Reads one line: x y z [intensity] [red green blue].
void parseCell(const InputFile& input, std::string_view line, const Shape& shape, Row& row, float& intensity) {
    double values[7] = {};
    std::string_view words = line;
    for (std::size_t i = 0; i < shape.words; ++i) {
        const std::string_view word = nextWord(words);
        if (!wholeNumber(word, values[i]))
            refuseLine(input, line.data(),
                       word.empty() ? fmt::format("has {} numbers, but {} are needed", i, shape.words)
                                    : fmt::format("{} is not a number", inQuotes(word)));
    }
    std::copy(values, values + 3, &row[kX]);
    if (shape.intensity) intensity = static_cast<float>(values[3]);
    if (shape.colors) std::copy(values + shape.words - 3, values + shape.words, &row[kRed]);
}

/// Whether the end of the file cuts off a line: it has no line end, and either more lines should follow or it lacks
/// numbers.
bool endsWithin(const InputFile& input, std::string_view line, const Shape& shape, bool is_last) {
    if (line.data() + line.size() != input.end()) return false;
    if (!is_last) return true;
    std::size_t words = 0;
    for (std::string_view rest = line; !nextWord(rest).empty();) ++words;
    return words < shape.words && !isMissing(line);
}

/// Statistics of one scan's cells.
struct Cells {
    std::uint64_t missing = 0;
    Eigen::AlignedBox3d box; ///< of the points, in the scan's frame
};

/// Cells come column by column. 0 0 0 marks a cell without a return.
Cells readCells(const InputFile& input, const PtxHeader& header, const Shape& shape, Lines& lines, Sink& sink) {
    Cells cells;
    Row row{};
    PackedCell packed;
    ReleasePagesBehind release_pages{input};
    const char* const values = reinterpret_cast<const char*>(&packed) + (shape.intensity ? 0 : sizeof packed.intensity);
    for (std::uint64_t i = 0; i < header.cells; ++i) {
        std::string_view line;
        if (!lines.next(line) || endsWithin(input, line, shape, i + 1 == header.cells)) {
            sink.acceptShort(input, i, header.cells);
            break;
        }
        release_pages(static_cast<std::uint64_t>(line.data() - input.begin()));
        if (isMissing(line)) {
            ++cells.missing;
            continue;
        }
        parseCell(input, line, shape, row, packed.intensity);
        const Vec3d position(row[kX], row[kY], row[kZ]);
        packed.row = static_cast<std::uint32_t>(i % header.rows);
        packed.column = static_cast<std::uint32_t>(i / header.rows);
        if (position.allFinite()) cells.box.extend(position);
        setCell(sink, packed.row, packed.column, sink.addVertex(row, values));
    }
    return cells;
}

/// Whether a header has only default values.
bool isDefault(const PtxHeader& header) {
    const Pose& pose = header.input_from_scan;
    return header.position.isZero(0) && pose.translation.isZero(0) && pose.linear.isIdentity(0);
}

/// Scanner position in the scan's frame: its origin or, if the points are registered already, the position in the
/// header; whichever is nearer to the points. With a default header, a scanner further away than ten times the size of
/// the scan is not plausible (nullopt): converters of points in a national grid write such files.
std::optional<Vec3d> sensorOf(const PtxHeader& header, const Cells& cells) {
    if (cells.box.isEmpty()) return std::nullopt;
    const Pose& pose = header.input_from_scan;
    const Vec3d origin = Vec3d::Zero(), given = pose.linear.inverse() * (header.position - pose.translation);
    const double to_origin = cells.box.exteriorDistance(origin), to_given = cells.box.exteriorDistance(given);
    constexpr double kFarthest = 10;
    if (isDefault(header) && to_origin > kFarthest * cells.box.diagonal().norm()) return std::nullopt;
    return to_given < to_origin ? given : origin;
}

/// Returns the number of cells without a point.
std::uint64_t readScan(const InputFile& input, const PtxHeader& header, std::size_t number, Lines& lines, Sink& sink) {
    const Shape shape = shapeOf(input, lines, header.cells);
    sink.transform.input_from_scan = header.input_from_scan;
    sink.beginScan(input, traitsOf(header, shape, input.bytes.size()));
    if (header.cells <= input.bytes.size()) beginGrid(sink, header.rows, header.columns);
    const Cells cells = readCells(input, header, shape, lines, sink);
    sink.setScanSensor(sensorOf(header, cells));
    Lines after = lines;
    std::string_view line;
    const bool only_one = number == 1 && !after.next(line);
    sink.finishScan(input, only_one ? "" : fmt::format("scan {}", number), Emptiness::kAllowed);
    sink.transform.input_from_scan.reset();
    return cells.missing;
}

void readScans(const InputFile& input, Lines& lines, Sink& sink) {
    std::string_view line;
    std::uint64_t missing = 0, cells = 0;
    const std::size_t points_before = sink.cloud.points_read;
    for (std::size_t number = 1; lines.next(line); ++number) {
        if (sink.salvages && number > 1 &&
            !isPtxStart(std::string_view(line.data(), std::size_t(input.end() - line.data())))) {
            sink.note(input, fmt::format("ends within the header of scan {}: the scans before are read", number));
            break;
        }
        const PtxHeader header = readHeader(input, line, sink.salvages, lines);
        missing += readScan(input, header, number, lines, sink);
        cells += header.cells;
    }
    if (sink.cloud.points_read == points_before) refuse(input, "holds no points");
    if (missing > 0) sink.note(input, fmt::format("{} of {} cells of its grids have no point", missing, cells));
}

void readPtx(const InputFile& input, Sink& sink) {
    Lines lines{input.bytes};
    const auto file_progress = sink.progress;
    if (file_progress)
        sink.progress = [&](double) {
            file_progress(1 - static_cast<double>(lines.rest.size()) / static_cast<double>(input.bytes.size()));
        };
    readScans(input, lines, sink);
    sink.progress = file_progress;
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.up_by_custom = true;
    frame.metres_per_unit = 1;
    sink.setWorldFrame(input, frame);
}

} // namespace

const FormatReader readers::kPtx{.isStart = isPtxStart, .read = readPtx, .readsInBatches = alwaysInBatches};

} // namespace pointrt

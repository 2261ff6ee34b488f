// SPDX-License-Identifier: GPL-3.0-or-later
// The PCD format: https://pointclouds.org/documentation/tutorials/pcd_file_format.html
#include <bit>
#include <cmath>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/typed_word.h"
#include "preprocess/input/points/lzf.h"
#include "preprocess/input/points/pcd_header.h"

namespace pointrt {
namespace {

/// Packed colours in text are the 32 bits written as a float or, by newer writers and whatever the TYPE, as an integer,
/// which has neither decimal point nor exponent.
std::uint32_t packedColor(std::string_view word, char type, double value) {
    const bool as_float = type == 'F' && word.find_first_of(".eEnN") != std::string_view::npos;
    if (as_float) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    if (!(std::abs(value) < 4294967296.0)) return 0;
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
}

/// Reads one number of a field. Returns false if the word is not a number; sets exact to false if the type cannot hold
/// the number.
bool readWord(const PcdField& field, std::uint64_t component, std::string_view word, Row& row, char* packed,
              bool& exact) {
    if (field.place) {
        const Stored stored = storeWord(word, field.scalar, packed + *field.place + component * field.size);
        exact = exact && stored == Stored::kExactly;
        return stored != Stored::kNothing;
    }
    double& value = row[field.dimension];
    if (!wholeNumber(word, value)) return false;
    if (field.packed_color) setPackedColor(row, packedColor(word, field.type, value));
    return true;
}

void addPoint(Sink& sink, const PcdHeader& header, std::uint64_t index, const Row& row, const char* packed) {
    setCell(sink, index / header.grid_columns, index % header.grid_columns, sink.addVertex(row, packed));
}

/// Returns false at the end of the file.
bool readAsciiPoint(const InputFile& input, const PcdHeader& header, std::string_view& rest, Row& row, char* packed,
                    bool& exact) {
    for (const PcdField& field : header.fields)
        for (std::uint64_t k = 0; k < field.count; ++k) {
            const std::string_view word = nextWord(rest);
            if (word.empty()) return false;
            if (!readWord(field, k, word, row, packed, exact))
                refuseLine(input, word.data(), fmt::format("{} is not a number", inQuotes(word)));
        }
    return true;
}

void readAscii(const InputFile& input, const PcdHeader& header, Sink& sink) {
    std::string_view rest = header.body;
    Row row{};
    std::vector<char> packed(header.packed_size);
    bool exact = true;
    for (std::uint64_t i = 0; i < header.points; ++i) {
        if (!readAsciiPoint(input, header, rest, row, packed.data(), exact) ||
            // the end of the file may cut off digits of the last number
            (rest.empty() && sink.salvages && i + 1 < header.points)) {
            sink.acceptShort(input, i, header.points);
            break;
        }
        addPoint(sink, header, i, row, packed.data());
    }
    if (!exact) sink.note(input, "has numbers outside their declared types: the nearest values are used");
}

/// Layout of a field's values: interleaved by point, or all values of one field together.
struct FieldBytes {
    const PcdField* field;
    const char* first;
    std::size_t stride;
};

std::vector<FieldBytes> layOut(const PcdHeader& header, const char* bytes) {
    std::vector<FieldBytes> all;
    const bool by_field = header.data == PcdData::kCompressed;
    for (const PcdField& field : header.fields) {
        const std::size_t size = field.size * field.count;
        if (field.dimension != kIgnored || field.packed_color || field.place)
            all.push_back({&field, bytes, by_field ? size : header.point_size});
        bytes += by_field ? size * header.points : size;
    }
    return all;
}

/// points: number to read, at most that of the header
void readBytes(const PcdHeader& header, const char* bytes, std::uint64_t points, Sink& sink) {
    const std::vector<FieldBytes> fields = layOut(header, bytes);
    Row row{};
    std::vector<char> packed(header.packed_size);
    for (std::uint64_t i = 0; i < points; ++i) {
        for (const FieldBytes& field : fields) {
            const char* const at = field.first + i * field.stride;
            if (field.field->place)
                std::memcpy(packed.data() + *field.field->place, at, field.field->size * field.field->count);
            else if (field.field->packed_color)
                setPackedColor(row, static_cast<std::uint32_t>(loadScalar(at, Scalar::kU32, false)));
            else
                row[field.field->dimension] = loadScalar(at, field.field->scalar, false);
        }
        addPoint(sink, header, i, row, packed.data());
    }
}

/// Number of points whose values of all fields lie within the first bytes of the fields' columns.
std::uint64_t wholePoints(const PcdHeader& header, const std::string& bytes) {
    std::uint64_t points = header.points;
    for (const FieldBytes& field : layOut(header, bytes.data())) {
        const auto first = static_cast<std::size_t>(field.first - bytes.data());
        points = std::min<std::uint64_t>(points, first < bytes.size() ? (bytes.size() - first) / field.stride : 0);
    }
    return points;
}

/// Returns the uncompressed values. @param points receives the number of complete points
std::string unpackBody(const InputFile& input, const PcdHeader& header, Sink& sink, std::uint64_t& points) {
    // Two 32-bit sizes: of the compressed and of the uncompressed bytes.
    if (header.body.size() < 8) refuse(input, "truncated: the sizes of the compressed data are missing");
    const auto packed_size = static_cast<std::size_t>(loadScalar(header.body.data(), Scalar::kU32, false));
    const auto size = static_cast<std::size_t>(loadScalar(header.body.data() + 4, Scalar::kU32, false));
    const std::string_view packed = header.body.substr(8);
    if (size / header.point_size != header.points || size % header.point_size != 0)
        refuse(input, fmt::format("{} points of {} bytes do not add up to the {} bytes announced", header.points,
                                  header.point_size, size));
    std::string bytes;
    const bool is_cut = packed_size > packed.size();
    const bool can_be = size <= packed_size * kLargestLzfGain;
    if (!can_be || (!unpackLzf(packed.substr(0, packed_size), size, bytes) && !is_cut))
        refuse(input, "the compressed data is invalid");
    if (!is_cut) return bytes;
    points = wholePoints(header, bytes);
    sink.acceptShort(input, points, header.points,
                     fmt::format("truncated to {} of {} compressed bytes", packed.size(), packed_size));
    return bytes;
}

/// Returns the number of points in the file.
std::uint64_t checkBodySize(const InputFile& input, const PcdHeader& header, Sink& sink) {
    const std::uint64_t room = header.body.size() / header.point_size;
    if (header.data == PcdData::kBinary && header.points > room) {
        sink.acceptShort(input, room, header.points);
        return room;
    }
    std::uint64_t values = 0;
    for (const PcdField& field : header.fields) values += field.count;
    // A value takes at least two bytes, a digit and a separator; the last one needs no separator.
    const bool ascii = header.data == PcdData::kAscii && !sink.salvages;
    if (ascii && header.points > (header.body.size() + 1) / (2 * values))
        refuse(input,
               fmt::format("the header promises {} points, but only {} bytes follow; --salvage reads the intact part",
                           header.points, header.body.size()));
    return header.points;
}

/// points: number of unpacked points, if they are compressed
ScanTraits traitsOf(const PcdHeader& header, std::uint64_t points) {
    ScanTraits traits;
    traits.vertices =
        header.data == PcdData::kCompressed ? points : std::min<std::uint64_t>(header.points, header.body.size());
    traits.faces = false;
    traits.columns = header.columns;
    for (const PcdField& field : header.fields) {
        traits.normals = traits.normals || field.dimension == kNormalX;
        traits.colors = traits.colors || field.dimension == kRed || field.packed_color;
        if (field.dimension == kRed)
            traits.color_scale = isReal(field.scalar) ? ColorScale::kReal : ColorScale::kInteger;
    }
    return traits;
}

/// Recognises files that do not start with the comment.
bool isFirstPcdLine(std::string_view line, bool first) {
    const std::string_view word = nextWord(line);
    return first && (word == "VERSION" || word == "FIELDS" || word == "COLUMNS");
}

/// Compressed bodies must be unpacked at once.
bool isUncompressed(const InputFile& input) { return readPcdHeader(input).data != PcdData::kCompressed; }

bool isPcdStart(std::string_view bytes) { return bytes.starts_with("# .PCD"); }

void readPcd(const InputFile& input, Sink& sink) {
    const PcdHeader header = readPcdHeader(input);
    std::uint64_t points = checkBodySize(input, header, sink);
    std::string unpacked;
    if (header.data == PcdData::kCompressed) unpacked = unpackBody(input, header, sink, points);
    if (!header.unread.empty())
        sink.note(input, "fields with more than 4 components or a duplicate name are not read: " + header.unread);
    sink.beginScan(input, traitsOf(header, points));
    sink.setScanSensor(header.sensor);
    const std::uint64_t bytes = std::max(unpacked.size(), header.body.size());
    if (header.points <= bytes) // cells then take no more memory than the file or its unpacked data
        beginGrid(sink, header.grid_rows, header.grid_columns);
    if (header.data == PcdData::kAscii)
        readAscii(input, header, sink);
    else
        readBytes(header, header.data == PcdData::kBinary ? header.body.data() : unpacked.data(), points, sink);
    sink.finishScan(input);
}

} // namespace

const FormatReader readers::kPcd{
    .isStart = isPcdStart, .isLine = isFirstPcdLine, .read = readPcd, .readsInBatches = isUncompressed};

} // namespace pointrt

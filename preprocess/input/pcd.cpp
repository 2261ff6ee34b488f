// SPDX-License-Identifier: GPL-3.0-or-later
// The PCD format: https://pointclouds.org/documentation/tutorials/pcd_file_format.html
#include <bit>
#include <cmath>

#include "preprocess/input/formats.h"
#include "preprocess/input/lzf.h"
#include "preprocess/input/pcd_header.h"
#include "preprocess/input/typed_word.h"

namespace pointrt {
namespace {

void setPackedColor(Row& row, std::uint32_t rgb) {
    row[kRed] = rgb >> 16 & 255;
    row[kGreen] = rgb >> 8 & 255;
    row[kBlue] = rgb & 255;
}

/// Packed colours in text are the number that the 32 bits make as a float or, from newer writers whatever the TYPE
/// says, as an integer, which has neither point nor exponent.
std::uint32_t packedColor(std::string_view word, char type, double value) {
    const bool as_float = type == 'F' && word.find_first_of(".eEnN") != std::string_view::npos;
    if (as_float) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    if (!(std::abs(value) < 4294967296.0)) return 0;
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
}

/// Reads one number of a field. False where the word is none; exact turns false where its type does not hold it.
bool readWord(const PcdField& field, std::uint64_t component, std::string_view word, Row& row, char* packed,
              bool& exact) {
    if (field.place) {
        const Stored stored = storeWord(word, field.scalar, packed + *field.place + component * field.size);
        exact = exact && stored == Stored::kExactly;
        return stored != Stored::kNothing;
    }
    double& value = row[field.role];
    if (!wholeNumber(word, value)) return false;
    if (field.packed_color) setPackedColor(row, packedColor(word, field.type, value));
    return true;
}

void addPoint(Sink& sink, const PcdHeader& header, std::uint64_t index, const Row& row, const char* packed) {
    setCell(sink, index / header.grid_columns, index % header.grid_columns, addVertex(sink, row, packed));
}

void readAscii(const Source& source, const PcdHeader& header, Sink& sink) {
    std::string_view rest = header.body;
    Row row{};
    std::vector<char> packed(header.packed_size);
    bool exact = true;
    for (std::uint64_t i = 0; i < header.points; ++i) {
        for (const PcdField& field : header.fields) {
            for (std::uint64_t k = 0; k < field.count; ++k) {
                const std::string_view word = nextWord(rest);
                if (word.empty()) refuse(source, fmt::format("cut short: {} of {} points are there", i, header.points));
                if (!readWord(field, k, word, row, packed.data(), exact))
                    refuseLine(source, word.data(), fmt::format("{} is no number", inQuotes(word)));
            }
        }
        addPoint(sink, header, i, row, packed.data());
    }
    if (!exact) addNote(sink.cloud, source.name, "has numbers that their types do not hold: the nearest ones are read");
}

/// Where a field's values lie: the point's own bytes one after the other, or all points' values of one field.
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
        if (field.role != kIgnored || field.packed_color || field.place)
            all.push_back({&field, bytes, by_field ? size : header.point_size});
        bytes += by_field ? size * header.points : size;
    }
    return all;
}

void readBytes(const PcdHeader& header, const char* bytes, Sink& sink) {
    const std::vector<FieldBytes> fields = layOut(header, bytes);
    Row row{};
    std::vector<char> packed(header.packed_size);
    for (std::uint64_t i = 0; i < header.points; ++i) {
        for (const FieldBytes& field : fields) {
            const char* const at = field.first + i * field.stride;
            if (field.field->place)
                std::memcpy(packed.data() + *field.field->place, at, field.field->size * field.field->count);
            else if (field.field->packed_color)
                setPackedColor(row, static_cast<std::uint32_t>(loadScalar(at, Scalar::kU32, false)));
            else
                row[field.field->role] = loadScalar(at, field.field->scalar, false);
        }
        addPoint(sink, header, i, row, packed.data());
    }
}

std::string unpackBody(const Source& source, const PcdHeader& header) {
    // The sizes, 32 bits each, are those of the packed and the unpacked bytes.
    if (header.body.size() < 8) refuse(source, "cut short: the sizes of the compressed data are missing");
    const auto packed_size = static_cast<std::size_t>(loadScalar(header.body.data(), Scalar::kU32, false));
    const auto size = static_cast<std::size_t>(loadScalar(header.body.data() + 4, Scalar::kU32, false));
    const std::string_view packed = header.body.substr(8);
    if (packed_size > packed.size())
        refuse(source, fmt::format("cut short: {} of {} compressed bytes are there", packed.size(), packed_size));
    if (size / header.point_size != header.points || size % header.point_size != 0)
        refuse(source, fmt::format("{} points of {} bytes do not make the {} bytes announced", header.points,
                                   header.point_size, size));
    std::string bytes;
    if (size > packed_size * kLargestLzfGain || !unpackLzf(packed.substr(0, packed_size), size, bytes))
        refuse(source, "the compressed data is broken");
    return bytes;
}

void checkBodySize(const Source& source, const PcdHeader& header) {
    if (header.data == PcdData::kBinary && header.points > header.body.size() / header.point_size)
        refuse(source, fmt::format("cut short: {} of {} points are there", header.body.size() / header.point_size,
                                   header.points));
    std::uint64_t values = 0;
    for (const PcdField& field : header.fields) values += field.count;
    // A value takes two bytes at least, a digit and what separates it from the next; the last needs no separator.
    if (header.data == PcdData::kAscii && header.points > (header.body.size() + 1) / (2 * values))
        refuse(source, fmt::format("the header promises {} points, only {} bytes are left for them", header.points,
                                   header.body.size()));
}

ScanTraits traitsOf(const PcdHeader& header) {
    ScanTraits traits;
    traits.vertices = header.points;
    traits.faces = false;
    traits.columns = header.columns;
    for (const PcdField& field : header.fields) {
        traits.normals = traits.normals || field.role == kNormalX;
        traits.colors = traits.colors || field.role == kRed || field.packed_color;
        if (field.role == kRed) traits.color_scale = isReal(field.scalar) ? ColorScale::kReal : ColorScale::kInteger;
    }
    return traits;
}

/// Files without the comment at their start.
bool isFirstPcdLine(std::string_view line, bool first) {
    const std::string_view word = nextWord(line);
    return first && (word == "VERSION" || word == "FIELDS" || word == "COLUMNS");
}

/// Compressed bodies are unpacked as a whole.
bool isUnpacked(const Source& source) { return readPcdHeader(source).data != PcdData::kCompressed; }

bool isPcdStart(std::string_view bytes) { return bytes.starts_with("# .PCD"); }

void readPcd(const Source& source, Sink& sink) {
    const PcdHeader header = readPcdHeader(source);
    checkBodySize(source, header);
    std::string unpacked;
    if (header.data == PcdData::kCompressed) unpacked = unpackBody(source, header);
    if (!header.unread.empty())
        addNote(sink.cloud, source.name,
                "fields of more than 4 numbers, or whose name is another's, are not read: " + header.unread);
    beginScan(sink, source, traitsOf(header));
    sink.sensor = header.sensor;
    beginGrid(sink, header.grid_rows, header.grid_columns);
    if (header.data == PcdData::kAscii)
        readAscii(source, header, sink);
    else
        readBytes(header, header.data == PcdData::kBinary ? header.body.data() : unpacked.data(), sink);
    finishScan(sink, source);
}

} // namespace

const FormatReader readers::kPcd{
    .isStart = isPcdStart, .isLine = isFirstPcdLine, .read = readPcd, .readsInBatches = isUnpacked};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// The Object File Format of Geomview (OFF, COFF, NOFF, CNOFF), as text.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

struct OffHeader {
    bool normals = false, colors = false;
    std::uint64_t vertices = 0, faces = 0;
};

std::uint64_t count(const InputFile& input, std::string_view& line) {
    const std::string_view word = nextWord(line);
    std::uint64_t value = 0;
    if (!wholeInteger(word, value)) refuseLine(input, word.data(), "expected the numbers of vertices and faces");
    return value;
}

/// "0 0 0\n" is the shortest vertex, "0\n" the shortest face.
void checkPromises(const InputFile& input, const OffHeader& header, std::size_t left) {
    if (header.vertices > left / 6 + 1 || header.faces > left / 2 + 1)
        refuse(input, fmt::format("the header promises {} vertices and {} faces, but only {} bytes follow",
                                  header.vertices, header.faces, left));
}

OffHeader readHeader(const InputFile& input, Lines& lines) {
    std::string_view line;
    if (!lines.next(line)) refuse(input, "does not start with OFF");
    OffHeader header;
    std::string_view keyword = nextWord(line);
    if (const std::size_t digit = keyword.find_first_of("0123456789"); // "OFF400 398 0", as ModelNet40 has it
        digit != std::string_view::npos && keyword.substr(0, digit).ends_with("OFF")) {
        line = std::string_view(keyword.data() + digit, keyword.size() - digit + line.size());
        keyword = keyword.substr(0, digit);
    }
    header.normals = keyword == "NOFF" || keyword == "CNOFF";
    header.colors = keyword == "COFF" || keyword == "CNOFF";
    if (keyword != "OFF" && !header.normals && !header.colors)
        refuseLine(
            input, keyword.data(),
            fmt::format("unsupported keyword {}; this build reads OFF, COFF, NOFF and CNOFF", inQuotes(keyword)));
    std::string_view words = line;
    const std::string_view next = nextWord(words);
    if (next == "BINARY") refuse(input, "binary OFF is not supported, only text");
    if (next.empty() && !lines.next(line)) refuse(input, "truncated after its first word");
    header.vertices = count(input, line);
    header.faces = count(input, line);
    checkPromises(input, header, lines.rest.size());
    return header;
}

/// Numbers of one vertex: x y z [nx ny nz] [r g b [a]].
struct Vertex {
    double values[10];
    std::size_t size = 0;
};

Vertex parseVertex(const InputFile& input, std::string_view line, std::size_t least) {
    Vertex vertex;
    const char* const place = line.data();
    for (std::string_view word = nextWord(line); !word.empty() && vertex.size < 10; word = nextWord(line))
        if (!wholeNumber(word, vertex.values[vertex.size++]))
            refuseLine(input, place, fmt::format("{} is not a number", inQuotes(word)));
    if (vertex.size < least)
        refuseLine(input, place, fmt::format("has {} numbers, but {} are needed", vertex.size, least));
    return vertex;
}

/// Colours may follow a position whatever the keyword says; the first vertex decides.
void detectColors(const InputFile& input, Lines lines, OffHeader& header) {
    std::string_view line;
    const std::size_t first = header.normals ? 6 : 3;
    if (header.vertices == 0 || !lines.next(line)) return;
    header.colors = parseVertex(input, line, first).size >= first + 3;
}

void readVertices(const InputFile& input, const OffHeader& header, Lines& lines, Sink& sink) {
    const std::size_t color_at = header.normals ? 6 : 3;
    Row row{};
    std::string_view line;
    for (std::uint64_t i = 0; i < header.vertices; ++i) {
        if (!lines.next(line)) refuse(input, fmt::format("truncated: found {} of {} vertices", i, header.vertices));
        const Vertex vertex = parseVertex(input, line, color_at + (header.colors ? 3 : 0));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            row[kX + axis] = vertex.values[axis];
            if (header.normals) row[kNormalX + axis] = vertex.values[3 + axis];
            if (header.colors) row[kRed + axis] = vertex.values[color_at + axis];
        }
        sink.addVertex(row);
    }
}

/// The three or four numbers after the corners of a face; a single number is an index into a colour map, which is not
/// read.
std::optional<std::array<double, 3>> colorOfFace(std::string_view line) {
    std::array<double, 3> color{};
    for (double& value : color)
        if (!wholeNumber(nextWord(line), value) || !std::isfinite(value)) return std::nullopt;
    return color;
}

/// @param line the rest of the line after the corners
/// @param full the largest value
PolygonPaint faceColor(std::string_view line, double full) {
    PolygonPaint paint;
    const auto color = colorOfFace(line);
    if (!color) return paint;
    paint.picture = FacePaint::kPlain;
    for (std::size_t i = 0; i < 3; ++i)
        paint.color[i] = static_cast<std::uint8_t>(std::clamp((*color)[i] / full, 0.0, 1.0) * 255 + 0.5);
    return paint;
}

/// The value of a fully bright colour of faces: 1 if no value is larger, else 255.
double fullFaceColor(std::uint64_t faces, Lines lines) {
    std::string_view line;
    for (std::uint64_t i = 0; i < faces && lines.next(line); ++i) {
        std::uint64_t size = 0;
        if (!wholeInteger(nextWord(line), size)) break;
        for (; size > 0 && !line.empty(); --size) nextWord(line);
        const auto color = colorOfFace(line);
        if (color && *std::max_element(color->begin(), color->end()) > 1) return 255;
    }
    return 1;
}

void readFaces(const InputFile& input, const OffHeader& header, Lines& lines, Sink& sink) {
    const double full = header.colors ? 1 : fullFaceColor(header.faces, lines);
    std::vector<std::uint32_t> corners;
    std::string_view line;
    for (std::uint64_t i = 0; i < header.faces; ++i) {
        if (!lines.next(line)) refuse(input, fmt::format("truncated: found {} of {} faces", i, header.faces));
        std::uint64_t size = 0;
        if (!wholeInteger(nextWord(line), size))
            refuseLine(input, line.data(), "a face starts with its number of corners");
        corners.clear();
        for (std::uint64_t k = 0; k < size; ++k) {
            const std::string_view word = nextWord(line);
            std::uint64_t index = 0;
            if (!wholeInteger(word, index))
                refuseLine(input, word.data(), fmt::format("{} is not a vertex index", inQuotes(word)));
            if (index >= header.vertices)
                refuseLine(
                    input, word.data(),
                    fmt::format("vertex index {} is out of range (the file has {} vertices)", index, header.vertices));
            corners.push_back(static_cast<std::uint32_t>(index));
        }
        sink.addPolygon(corners, header.colors ? PolygonPaint{} : faceColor(line, full));
    }
}

bool isKeywordLine(std::string_view line, bool first) {
    const std::string_view word = nextWord(line);
    const std::string_view keyword = word.substr(0, word.find_last_not_of("0123456789") + 1);
    return first && keyword.ends_with("OFF") && keyword.size() <= 9; // the longest is STCN4nOFF
}

void readOff(const InputFile& input, Sink& sink) {
    Lines lines{input.bytes, true};
    OffHeader header = readHeader(input, lines);
    detectColors(input, lines, header);
    ScanTraits traits;
    traits.vertices = header.vertices;
    traits.normals = header.normals;
    traits.colors = header.colors;
    traits.color_scale = ColorScale::kReal;
    sink.beginScan(input, traits);
    readVertices(input, header, lines, sink);
    readFaces(input, header, lines, sink);
    sink.finishScan(input);
}

} // namespace

const FormatReader readers::kOff{.isLine = isKeywordLine, .read = readOff};

} // namespace pointrt

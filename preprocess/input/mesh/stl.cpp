// SPDX-License-Identifier: GPL-3.0-or-later
// STL: triangles as text, or binary with the colours of VisCAM, SolidView and Magics.
#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

constexpr std::size_t kStlHeader = 80, kStlPrologue = 84, kStlTriangle = 50; // bytes

std::uint64_t promisedTriangles(std::string_view bytes) {
    return static_cast<std::uint64_t>(loadScalar(bytes.data() + kStlHeader, Scalar::kU32, false));
}

/// A header of 80 bytes, the number of triangles, 50 bytes for each.
bool isBinaryStl(std::string_view bytes) {
    return bytes.size() >= kStlPrologue + kStlTriangle && (bytes.size() - kStlPrologue) % kStlTriangle == 0 &&
           promisedTriangles(bytes) == (bytes.size() - kStlPrologue) / kStlTriangle;
}

/// "solid NAME" and, on the next line, "facet normal x y z".
bool isTextStl(std::string_view bytes) {
    std::string_view line;
    if (nextWord(bytes) != "solid" || !nextLine(bytes, line)) return false;
    const std::string_view word = nextWord(bytes);
    return word == "facet" || word == "endsolid";
}

/// Triangles share the vertices at which they meet; the file repeats these for each triangle.
class SharedVertices {
public:
    explicit SharedVertices(Sink& sink) : sink_(sink) {}

    std::uint32_t indexOf(std::array<double, 3> position) {
        for (double& value : position) value += 0.0; // makes -0 and 0 the same bytes
        const auto [found, is_new] = index_.try_emplace(keyOf(position), static_cast<std::uint32_t>(index_.size()));
        if (is_new) {
            std::copy(position.begin(), position.end(), row_.begin() + kX);
            sink_.addVertex(row_);
        }
        return found->second;
    }

private:
    static std::string keyOf(const std::array<double, 3>& position) {
        std::string key(sizeof position, '\0');
        std::memcpy(key.data(), position.data(), sizeof position);
        return key;
    }

    Sink& sink_;
    Row row_{};
    std::unordered_map<std::string, std::uint32_t> index_;
};

/// How the two bytes after a triangle encode its colour, if they do. Both encodings have 5 bits for each of red, green
/// and blue.
enum class StlColors { kNone, kVisCam, kMagics };

StlColors colorsOf(std::string_view bytes, std::uint64_t triangles) {
    if (bytes.substr(0, kStlHeader).find("COLOR=") != std::string_view::npos) return StlColors::kMagics;
    for (std::uint64_t i = 0; i < triangles; ++i)
        if ((bytes[kStlPrologue + i * kStlTriangle + kStlTriangle - 1] & '\x80') != 0) return StlColors::kVisCam;
    return StlColors::kNone;
}

/// VisCAM sets bit 15 of a coloured face and has red in the highest bits. Magics sets bit 15 of a face without a colour
/// and has red in the lowest bits.
PolygonPaint paintOf(StlColors colors, std::uint32_t bits) {
    PolygonPaint paint;
    const bool marked = (bits >> 15) != 0;
    if (colors == StlColors::kNone || marked != (colors == StlColors::kVisCam)) return paint;
    paint.picture = FacePaint::kPlain;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t shift = 5 * (colors == StlColors::kVisCam ? 2 - i : i);
        paint.color[i] = static_cast<std::uint8_t>((bits >> shift & 31) * 255 / 31);
    }
    return paint;
}

void beginMesh(const InputFile& input, std::uint64_t triangles, Sink& sink) {
    ScanTraits traits;
    traits.vertices = triangles / 2; // of a closed mesh
    sink.beginScan(input, traits);
}

void readBinaryStl(const InputFile& input, Sink& sink) {
    if (input.bytes.size() < kStlPrologue) refuse(input, "truncated: an STL header has 84 bytes");
    const std::uint64_t promised = promisedTriangles(input.bytes),
                        found = (input.bytes.size() - kStlPrologue) / kStlTriangle;
    if (found < promised) sink.acceptShort(input, 3 * found, 3 * promised);
    const std::uint64_t triangles = std::min(promised, found);
    beginMesh(input, triangles, sink);
    const StlColors colors = colorsOf(input.bytes, triangles);
    SharedVertices vertices(sink);
    for (std::uint64_t i = 0; i < triangles; ++i) {
        const char* at = input.begin() + kStlPrologue + i * kStlTriangle + 12; // after the normal
        std::array<std::uint32_t, 3> corners{};
        for (std::uint32_t& corner : corners) {
            std::array<double, 3> position{};
            for (double& value : position) value = loadScalar(at, Scalar::kF32, false), at += 4;
            corner = vertices.indexOf(position);
        }
        sink.addPolygon(corners, paintOf(colors, static_cast<std::uint32_t>(loadScalar(at, Scalar::kU16, false))));
    }
}

std::array<double, 3> cornerOf(const InputFile& input, std::string_view line) {
    std::array<double, 3> position{};
    const char* const place = line.data();
    for (double& value : position)
        if (!wholeNumber(nextWord(line), value)) refuseLine(input, place, "a vertex needs 3 numbers");
    return position;
}

void endFacet(const InputFile& input, const char* place, std::vector<std::uint32_t>& corners, Sink& sink) {
    if (corners.size() < 3) refuseLine(input, place, fmt::format("a facet has {} vertices", corners.size()));
    sink.addPolygon(corners);
    corners.clear();
}

void readTextStl(const InputFile& input, Sink& sink) {
    constexpr std::size_t kShortestTriangle = 80; // bytes of text, with one digit for each number
    beginMesh(input, input.bytes.size() / kShortestTriangle, sink);
    SharedVertices vertices(sink);
    std::vector<std::uint32_t> corners;
    Lines lines{input.bytes};
    std::uint64_t triangles = 0;
    for (std::string_view line; lines.next(line);) {
        const std::string_view written = nextWord(line);
        const std::string word = lowerCase(written); // some programs write capitals
        if (word == "vertex") {
            corners.push_back(vertices.indexOf(cornerOf(input, line)));
        } else if (word == "endfacet") {
            endFacet(input, written.data(), corners, sink);
            ++triangles;
        } else if (word != "facet" && word != "outer" && word != "endloop" && word != "solid" && word != "endsolid" &&
                   word != "color") {
            refuseLine(input, written.data(), fmt::format("unknown word {}", inQuotes(written)));
        }
    }
    if (!corners.empty()) sink.acceptShort(input, 3 * triangles, 3 * triangles + 3);
}

bool isStlStart(std::string_view bytes) { return isTextStl(bytes) || isBinaryStl(bytes); }

void readStl(const InputFile& input, Sink& sink) {
    if (isTextStl(input.bytes) && !isBinaryStl(input.bytes))
        readTextStl(input, sink);
    else
        readBinaryStl(input, sink);
    sink.finishScan(input);
}

} // namespace

const FormatReader readers::kStl{.isStart = isStlStart, .read = readStl};

} // namespace pointrt

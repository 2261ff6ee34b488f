// SPDX-License-Identifier: GPL-3.0-or-later
// The PLY format: Greg Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>

#include "preprocess/input/formats/formats.h"
#include "preprocess/input/formats/ply/ply_header.h"
#include "preprocess/input/source/text.h"

namespace pointrt {
namespace {

/// Values one after the other, as words.
struct AsciiValues {
    const char* at;
    const char* end;

    bool next(Scalar, double& value) {
        while (at < end && isSpace(*at)) ++at;
        const char* const stop = at < end ? parseNumber(at, end, value) : nullptr;
        if (!stop || (stop < end && !isSpace(*stop))) return false;
        at = stop;
        return true;
    }
};

/// Values one after the other, as bytes.
struct BinaryValues {
    const char* at;
    const char* end;
    bool swap_bytes;

    bool next(Scalar type, double& value) {
        const std::size_t size = scalarSize(type);
        if (static_cast<std::size_t>(end - at) < size) return false;
        value = loadScalar(at, type, swap_bytes);
        at += size;
        return true;
    }
};

[[noreturn]] void refuseValue(const Source& source, const char* at, const PlyElement& element, std::uint64_t done) {
    if (at == source.end())
        refuse(source, fmt::format("cut short: {} of {} {} are there", done, element.count, pluralOf(element)));
    std::string_view rest(at, static_cast<std::size_t>(source.end() - at));
    refuseLine(source, at, fmt::format("{} is no number", quoted(nextWord(rest))));
}

/// The elements of one file, read with one kind of values.
template <typename Values>
struct Body {
    const Source& source;
    const PlyHeader& header;
    Sink& sink;
    Values values;
    std::vector<std::uint32_t> corners;

    void value(const PlyElement& element, std::uint64_t index, Scalar type, double& into) {
        if (values.next(type, into)) return;
        if constexpr (std::is_same_v<Values, BinaryValues>) values.at = values.end;
        refuseValue(source, values.at, element, index);
    }

    std::uint64_t listLength(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        double length = 0;
        value(element, index, property.count_type, length);
        if (!(length >= 0 && length <= static_cast<double>(values.end - values.at)))
            refuseAt(source, fmt::format("{} {}", element.name, index),
                     fmt::format("impossible list length {}", length));
        return static_cast<std::uint64_t>(length);
    }

    void skip(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        double ignored = 0;
        const std::uint64_t count = property.is_list ? listLength(element, index, property) : 1;
        for (std::uint64_t i = 0; i < count; ++i) value(element, index, property.type, ignored);
    }

    void readVertices(const PlyElement& element) {
        Row row{};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (property.is_list)
                    skip(element, i, property);
                else
                    value(element, i, property.type, row[property.role]);
            }
            if (header.harmonic_colors) evaluateHarmonics(row);
            addVertex(sink, row);
        }
    }

    /// The constant term of the real spherical harmonics is 1 / (2 sqrt(pi)); splats store it around grey.
    static void evaluateHarmonics(Row& row) {
        constexpr double kConstantTerm = 0.28209479177387814;
        for (const Role role : {kRed, kGreen, kBlue}) row[role] = std::clamp(0.5 + kConstantTerm * row[role], 0.0, 1.0);
    }

    /// Corners of a face or a strip; a strip's -1 starts a new one.
    void readCorners(const PlyElement& element, std::uint64_t index, const PlyProperty& property, bool strip) {
        const std::uint64_t length = listLength(element, index, property);
        const auto vertex_count = static_cast<double>(vertexElement(header).count);
        corners.clear();
        for (std::uint64_t i = 0; i < length; ++i) {
            double corner = 0;
            value(element, index, property.type, corner);
            if (strip && corner == -1) {
                flushStrip();
                continue;
            }
            if (!(corner >= 0 && corner < vertex_count))
                refuseAt(source, fmt::format("{} {}", element.name, index),
                         fmt::format("vertex index {} is out of range, there are {} vertices", corner, vertex_count));
            corners.push_back(static_cast<std::uint32_t>(corner));
        }
        if (strip)
            flushStrip();
        else
            addPolygon(sink, corners);
    }

    /// Every other triangle of a strip has its first two corners swapped, so that all face one way.
    void flushStrip() {
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::size_t odd = i % 2;
            const std::uint32_t triangle[] = {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]};
            addPolygon(sink, triangle);
        }
        corners.clear();
    }

    void readFaces(const PlyElement& element, bool strip) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) {
                const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
                if (indices && property.is_list)
                    readCorners(element, i, property, strip);
                else
                    skip(element, i, property);
            }
    }

    void skipElement(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) skip(element, i, property);
    }

    void read() {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face" || element.name == "tristrips")
                readFaces(element, element.name == "tristrips");
            else
                skipElement(element);
        }
    }
};

ScanTraits traitsOf(const PlyHeader& header) {
    const PlyElement& vertex = vertexElement(header);
    ScanTraits traits;
    traits.vertices = vertex.count;
    for (const PlyProperty& property : vertex.properties) {
        traits.normals = traits.normals || property.role == kNormalX;
        if (property.role < kRed || property.role > kBlue) continue;
        traits.colors = true;
        if (isReal(property.type))
            traits.color_scale = ColorScale::kReal;
        else if (property.type != Scalar::kU8 && traits.color_scale == ColorScale::kByte)
            traits.color_scale = ColorScale::kInteger;
    }
    return traits;
}

bool isPlyStart(std::string_view bytes) { return bytes.starts_with("ply") && bytes.size() > 3 && isSpace(bytes[3]); }

void readPly(const Source& source, Sink& sink) {
    const PlyHeader header = readPlyHeader(source);
    beginScan(sink, source, traitsOf(header));
    if (header.gaussians)
        addNote(sink.cloud, source.name,
                "is a 3D Gaussian splatting file: centres and base colours are read, as bare points; sizes, rotations, "
                "opacities and colours by direction are not");
    if (header.encoding == PlyEncoding::kAscii)
        Body<AsciiValues>{source, header, sink, {header.body, source.end()}, {}}.read();
    else
        Body<BinaryValues>{
            source, header, sink, {header.body, source.end(), header.encoding == PlyEncoding::kBigEndian}, {}}
            .read();
    finishScan(sink, source);
}

} // namespace

const FormatReader readers::kPly{.isStart = isPlyStart, .read = readPly};

} // namespace pointrt

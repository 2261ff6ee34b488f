// SPDX-License-Identifier: GPL-3.0-or-later
// The PLY format: Greg Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>

#include "preprocess/input/formats/formats.h"
#include "preprocess/input/formats/ply/ply_attributes.h"
#include "preprocess/input/formats/ply/ply_body.h"
#include "preprocess/input/formats/ply/ply_gaussians.h"
#include "preprocess/input/formats/splats/gaussians.h"

namespace pointrt {
namespace {

/// The elements of one file, read with one kind of values.
template <typename Values>
struct Reader {
    const PlyHeader& header;
    Sink& sink;
    PlyBody<Values> body;
    std::vector<std::uint32_t> corners;

    void readVertices(const PlyElement& element) {
        Row row{};
        std::vector<char> packed(header.packed_size);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (property.is_list)
                    body.skip(element, i, property);
                else if (property.place)
                    body.valueAs(element, i, property.type, packed.data() + *property.place);
                else
                    body.value(element, i, property.type, row[property.role]);
            }
            if (header.harmonic_colors) evaluateHarmonics(row);
            addVertex(sink, row, packed.data());
        }
    }

    static void evaluateHarmonics(Row& row) {
        for (const Role role : {kRed, kGreen, kBlue})
            row[role] = std::clamp(0.5 + kConstantHarmonic * row[role], 0.0, 1.0);
    }

    /// Corners of a face or a strip; a strip's -1 starts a new one.
    void readCorners(const PlyElement& element, std::uint64_t index, const PlyProperty& property, bool strip) {
        const std::uint64_t length = body.listLength(element, index, property);
        const auto vertex_count = static_cast<double>(vertexElement(header).count);
        corners.clear();
        for (std::uint64_t i = 0; i < length; ++i) {
            double corner = 0;
            body.value(element, index, property.type, corner);
            if (strip && corner == -1) {
                flushStrip();
                continue;
            }
            if (!(corner >= 0 && corner < vertex_count))
                refuseAt(body.source, fmt::format("{} {}", element.name, index),
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
                    body.skip(element, i, property);
            }
    }

    void read() {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face" || element.name == "tristrips")
                readFaces(element, element.name == "tristrips");
            else
                body.skipElement(element);
        }
    }
};

ScanTraits traitsOf(const PlyHeader& header) {
    const PlyElement& vertex = vertexElement(header);
    ScanTraits traits;
    traits.vertices = vertex.count;
    traits.columns = header.columns;
    for (const PlyProperty& property : vertex.properties) {
        traits.normals = traits.normals || property.role == kNormalX;
        traits.radii = traits.radii || property.role == kRadius;
        if (property.role < kRed || property.role > kBlue) continue;
        traits.colors = true;
        if (property.place) {
            traits.color_scale = ColorScale::k16Bit;
            continue;
        }
        if (isReal(property.type))
            traits.color_scale = ColorScale::kReal;
        else if (property.type != Scalar::kU8 && traits.color_scale == ColorScale::kByte)
            traits.color_scale = ColorScale::kInteger;
    }
    return traits;
}

bool isPlyStart(std::string_view bytes) { return bytes.starts_with("ply") && bytes.size() > 3 && isSpace(bytes[3]); }

void readPly(const Source& source, Sink& sink) {
    PlyHeader header = readPlyHeader(source);
    if (header.gaussians != PlyGaussians::kNone) return readPlyGaussians(source, header, sink);
    const std::string unread = settlePlyAttributes(header);
    if (!unread.empty())
        addNote(sink.cloud, source.name,
                "properties that are lists, or whose name is another's, are not read: " + unread);
    beginScan(sink, source, traitsOf(header));
    withPlyBody(source, header, [&]<typename Values>(const PlyBody<Values>& body) {
        Reader<Values> reader{header, sink, body, {}};
        reader.read();
        if (!reader.body.exact)
            addNote(sink.cloud, source.name, "has numbers that their types do not hold: the nearest ones are read");
    });
    finishScan(sink, source);
}

} // namespace

const FormatReader readers::kPly{.isStart = isPlyStart, .read = readPly};

} // namespace pointrt

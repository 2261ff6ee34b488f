// SPDX-License-Identifier: GPL-3.0-or-later
// The PLY format: Greg Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>

#include "preprocess/input/formats.h"
#include "preprocess/input/gaussians.h"
#include "preprocess/input/ply_attributes.h"
#include "preprocess/input/ply_body.h"
#include "preprocess/input/ply_gaussians.h"

namespace pointrt {
namespace {

/// Of the Stanford 3D Scanning Repository: each cell takes a byte of the file at least.
bool isRangeGrid(const PlyHeader& header, const PlyElement& element) {
    std::uint64_t cells = 0;
    return element.name == "range_grid" && element.properties.size() == 1 && element.properties.front().is_list &&
           !__builtin_mul_overflow(header.grid_rows, header.grid_columns, &cells) && cells > 0 &&
           cells == element.count;
}

/// The elements of one file, read with one kind of values.
template <typename Values>
struct Reader {
    const PlyHeader& header;
    Sink& sink;
    PlyBody<Values> body;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> vertices; ///< as addVertex returned them, where a grid asks for them

    void readVertices(const PlyElement& element) {
        Row row{};
        std::vector<char> packed(header.packed_size);
        const bool for_grid = header.grid_rows > 0 && !sink.batches;
        LetGoBehind let_go{body.source};
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
            const std::uint32_t vertex = addVertex(sink, row, packed.data());
            if (for_grid) vertices.push_back(vertex);
            if (sink.batches) let_go(static_cast<std::uint64_t>(body.values.at - body.source.begin()));
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

    /// A list of a vertex or none for each cell, row by row; what names vertices that are not there is no grid.
    void readGrid(const PlyElement& element) {
        beginGrid(sink, header.grid_rows, header.grid_columns);
        const PlyProperty& cell = element.properties.front();
        for (std::uint64_t i = 0; i < element.count; ++i) {
            const std::uint64_t row = i / header.grid_columns, column = i % header.grid_columns;
            for (std::uint64_t k = body.listLength(element, i, cell); k > 0; --k) {
                double vertex = 0;
                body.value(element, i, cell.type, vertex);
                const bool known = vertex >= 0 && vertex < static_cast<double>(vertices.size());
                setCell(sink, known ? row : header.grid_rows, column,
                        known ? vertices[static_cast<std::size_t>(vertex)] : RangeGrid::kLeftOut);
            }
        }
    }

    void read() {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face" || element.name == "tristrips")
                readFaces(element, element.name == "tristrips");
            else if (isRangeGrid(header, element))
                readGrid(element);
            else
                body.skipElement(element);
        }
    }
};

ScanTraits traitsOf(const PlyHeader& header) {
    const PlyElement& vertex = vertexElement(header);
    ScanTraits traits;
    traits.vertices = vertex.count;
    traits.faces = hasFaces(header);
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

/// Whether there is nothing but points.
bool isOfPoints(const Source& source) {
    const PlyHeader header = readPlyHeader(source);
    return header.gaussians == PlyGaussians::kNone && !hasFaces(header) &&
           std::none_of(header.elements.begin(), header.elements.end(),
                        [&](const PlyElement& element) { return isRangeGrid(header, element); });
}

void readPly(const Source& source, Sink& sink) {
    PlyHeader header = readPlyHeader(source);
    if (header.gaussians != PlyGaussians::kNone) return readPlyGaussians(source, header, sink);
    const std::string unread = settlePlyAttributes(header);
    if (!unread.empty())
        addNote(sink.cloud, source.name,
                "properties that are lists, or whose name is another's, are not read: " + unread);
    beginScan(sink, source, traitsOf(header));
    withPlyBody(source, header, [&]<typename Values>(const PlyBody<Values>& body) {
        Reader<Values> reader{header, sink, body, {}, {}};
        reader.read();
        if (!reader.body.exact)
            addNote(sink.cloud, source.name, "has numbers that their types do not hold: the nearest ones are read");
    });
    const std::size_t grids = sink.cloud.grids.size();
    finishScan(sink, source);
    const bool has_grid = sink.cloud.grids.size() > grids;
    if (has_grid && !sink.world_from_scan) setSensorAlongZ(sink); // whoever places a scan knows its sensor
}

} // namespace

const FormatReader readers::kPly{.isStart = isPlyStart, .read = readPly, .readsInBatches = isOfPoints};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// The PLY format: Greg Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/gaussian/gaussians.h"
#include "preprocess/input/mesh/ply_attributes.h"
#include "preprocess/input/mesh/ply_body.h"
#include "preprocess/input/mesh/ply_gaussians.h"
#include "preprocess/input/mesh/ply_paint.h"

namespace pointrt {
namespace {

/// Range grids of the Stanford 3D Scanning Repository. Each cell takes at least a byte of the file.
bool isRangeGrid(const PlyHeader& header, const PlyElement& element) {
    std::uint64_t cells = 0;
    return element.name == "range_grid" && element.properties.size() == 1 && element.properties.front().is_list &&
           !__builtin_mul_overflow(header.grid_rows, header.grid_columns, &cells) && cells > 0 &&
           cells == element.count;
}

/// Reads the elements of one file, text or binary.
template <typename Values>
struct ElementReader {
    const PlyHeader& header;
    Sink& sink;
    PlyBody<Values> body;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> vertices; ///< as addVertex returned them, if there is a grid
    PlyPaint paint;
    std::uint64_t faces = 0;

    void readVertices(const PlyElement& element) {
        Row row{};
        std::vector<char> packed(header.packed_size);
        const bool for_grid = header.grid_rows > 0 && sink.keepsPoints();
        ReleasePagesBehind release_pages{body.input};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (property.is_list)
                    body.skip(element, i, property);
                else if (property.place)
                    body.valueAs(element, i, property.type, packed.data() + *property.place);
                else {
                    body.value(element, i, property.type, row[property.dimension]);
                    if (property.dimension == kIgnored) paint.takeOfVertex(property, row[kIgnored]);
                }
            }
            if (header.harmonic_colors) evaluateHarmonics(row);
            if (isCut(element, i)) body.refuseValue(element, i);
            paint.addVertex();
            const std::uint32_t vertex = sink.addVertex(row, packed.data());
            if (for_grid) vertices.push_back(vertex);
            if (!sink.keepsPoints()) release_pages(static_cast<std::uint64_t>(body.values.at - body.input.begin()));
        }
    }

    static void evaluateHarmonics(Row& row) {
        for (const Dimension dimension : {kRed, kGreen, kBlue})
            row[dimension] = std::clamp(0.5 + kConstantHarmonic * row[dimension], 0.0, 1.0);
    }

    /// Reads the corners of a face or a strip; -1 starts a new strip.
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
                refuseAt(
                    body.input, fmt::format("{} {}", element.name, index),
                    fmt::format("vertex index {} is out of range (the file has {} vertices)", corner, vertex_count));
            corners.push_back(static_cast<std::uint32_t>(corner));
        }
        if (strip) flushStrip();
    }

    void readPaint(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        const std::uint64_t count = property.is_list ? body.listLength(element, index, property) : 1;
        for (std::uint64_t i = 0; i < count; ++i) {
            double number = 0;
            body.value(element, index, property.type, number);
            paint.take(property, number);
        }
    }

    /// Swaps the first two corners of every other triangle, so that all face the same way.
    void flushStrip() {
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::size_t odd = i % 2;
            const std::uint32_t triangle[] = {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]};
            sink.addPolygon(triangle);
        }
        corners.clear();
    }

    void readFaces(const PlyElement& element, bool strip) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            paint.beginFace();
            corners.clear();
            for (const PlyProperty& property : element.properties) {
                const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
                if (indices && property.is_list)
                    readCorners(element, i, property, strip);
                else if (!strip && paint.takes(property))
                    readPaint(element, i, property);
                else
                    body.skip(element, i, property);
            }
            if (!strip) sink.addPolygon(corners, paint.paintOf(corners));
            ++faces;
        }
    }

    /// Reads a list of at most one vertex for each cell, row by row. An index of a missing vertex invalidates the grid.
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
                        known ? vertices[static_cast<std::size_t>(vertex)] : RangeGrid::kFilteredOut);
            }
        }
    }

    /// Reads the complete elements of a truncated file that is salvaged.
    void readWhole() {
        try {
            read();
        } catch (const PlyEnd&) { // the counts show how many there are
        }
        const PlyElement& vertex = vertexElement(header);
        if (sink.vertexCount() < vertex.promised)
            return sink.acceptShort(body.input, sink.vertexCount(), vertex.promised);
        for (const PlyElement& element : header.elements)
            if (element.name == "face" && faces < element.promised)
                sink.note(body.input, fmt::format("truncated: {} of {} faces are read", faces, element.promised));
    }

    /// Whether the end of the file may cut off digits of a vertex's last number.
    bool isCut(const PlyElement& element, std::uint64_t index) const {
        return header.encoding == PlyEncoding::kAscii && body.values.at == body.input.end() &&
               index + 1 < element.promised;
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
        traits.normals = traits.normals || property.dimension == kNormalX;
        traits.radii = traits.radii || property.dimension == kRadius;
        if (property.dimension < kRed || property.dimension > kBlue) continue;
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

/// Whether the file has only points.
bool isOfPoints(const InputFile& input) {
    const PlyHeader header = readPlyHeader(input, true);
    return header.gaussians == PlyGaussians::kNone && !hasFaces(header) &&
           std::none_of(header.elements.begin(), header.elements.end(),
                        [&](const PlyElement& element) { return isRangeGrid(header, element); });
}

/// If a header declares fewer elements than the file holds, the header is often wrong: the user must know.
void noteRest(const InputFile& input, const PlyHeader& header, std::string_view rest, Sink& sink) {
    if (std::all_of(rest.begin(), rest.end(), isSpace)) return;
    const bool is_text = header.encoding == PlyEncoding::kAscii;
    std::uint64_t count = is_text ? 0 : rest.size();
    std::string_view line;
    for (Lines lines{rest}; is_text && lines.next(line);) ++count;
    const PlyElement& vertex = vertexElement(header);
    sink.note(input, fmt::format("its header promises {} vertices, but {} more {} follow what it describes: they are "
                                 "not read; if they are points, correct the header",
                                 vertex.count, count, is_text ? "lines" : "bytes"));
}

void readPly(const InputFile& input, Sink& sink) {
    PlyHeader header = readPlyHeader(input, sink.salvages);
    if (header.gaussians != PlyGaussians::kNone) {
        const PlyElement& vertex = vertexElement(header);
        if (vertex.count < vertex.promised) sink.acceptShort(input, vertex.count, vertex.promised);
        return readPlyGaussians(input, header, sink);
    }
    const std::string unread = assignPlyAttributes(header);
    if (!unread.empty()) sink.note(input, "lists and properties with a duplicate name are not read: " + unread);
    sink.beginScan(input, traitsOf(header));
    withPlyBody(
        input, header,
        [&]<typename Values>(const PlyBody<Values>& body) {
            ElementReader<Values> reader{header, sink, body, {}, {}, PlyPaint(input, header, sink)};
            if (sink.salvages)
                reader.readWhole();
            else
                reader.read();
            if (!reader.body.exact)
                sink.note(input, "has numbers outside their declared types: the nearest values are used");
            if (!sink.salvages) noteRest(input, header, {reader.body.values.at, input.end()}, sink);
        },
        sink.salvages);
    const std::size_t grids = sink.cloud.grids.size();
    sink.finishScan(input);
    const bool has_grid = sink.cloud.grids.size() > grids;
    if (has_grid && !sink.transform.input_from_scan)
        sink.setSensorAlongZ(); // a .conf that poses the scan sets its sensor
}

} // namespace

const FormatReader readers::kPly{.isStart = isPlyStart, .read = readPly, .readsInBatches = isOfPoints};

} // namespace pointrt

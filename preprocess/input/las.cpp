// SPDX-License-Identifier: GPL-3.0-or-later
// LAS files, LAZ and COPC among them.

#include <algorithm>

#include "format/pointio/las_crs.h"
#include "format/pointio/las_source_header.h"
#include "preprocess/input/degrees.h"
#include "preprocess/input/formats.h"
#include "preprocess/input/las_blocks.h"
#include "preprocess/input/las_nodes.h"

namespace pointrt {
namespace {

/// Runs work of format/pointio, whose errors do not name the file.
template <typename Work>
auto named(const Source& source, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code, fmt::format("{}: {}", source.name, error.what()));
    }
}

Scalar scalarOf(std::uint32_t pro_type) { return static_cast<Scalar>(pro_type - 1); }

ScanTraits traitsOf(const LasFile& file, const std::vector<LasField>& fields, std::uint64_t points) {
    ScanTraits traits;
    traits.faces = false;
    for (const LasField& field : fields) {
        ColumnTraits column{field.name, scalarOf(field.type), field.components};
        column.minor = field.minor;
        traits.columns.push_back(column);
        if (field.name != kRgb16 || field.extra) continue;
        traits.colors = true;
        traits.color_scale = ColorScale::k16Bit;
    }
    // A few bytes of a LAZ file may promise any number: room is made for what is usual, more as it comes.
    const std::uint64_t usual = file.bytes.size() - file.header.point_offset;
    traits.vertices = std::min(points, usual);
    return traits;
}

/// The chunks to read; a file that is not COPC is read whole.
std::vector<LazChunk> chunksOf(const Source& source, const LasFile& file, const LazLayout& layout, Sink& sink) {
    const bool chooses = sink.level || sink.filter.options().bounds;
    if (sink.level && !isCopc(file)) noteWithoutLevels(source, sink);
    if (!file.header.packed) {
        const std::uint64_t bytes = file.header.point_count * file.header.record_bytes;
        return {{file.header.point_offset, bytes, file.header.point_count}};
    }
    return chooses && isCopc(file) ? wantedNodes(file, sink) : layout.chunks;
}

/// Scans from the air see every surface from above; a box that is this much wider than high, in metres this wide, was
/// hardly scanned otherwise.
bool isAirborne(const Sink& sink, const LasCrs& crs) {
    constexpr double kFlat = 2, kWide = 50;
    const ScanBox box = boxOfScan(sink);
    Vec3d size = box.size;
    if (crs.kind == LasCrs::Kind::kGeographic)
        size.head<2>() = size.head<2>().cwiseProduct(metresPerDegree(box.center.y()));
    const double width = size.head<2>().maxCoeff();
    return width > kFlat * size.z() && width * (crs.metres_per_unit > 0 ? crs.metres_per_unit : 1) > kWide;
}

/// Up is z in every system of coordinates that LAS files are in, but for those that measure from the earth's middle.
void tellFrame(const LasCrs& crs, const Source& source, Sink& sink) {
    WorldFrame frame;
    if (crs.kind != LasCrs::Kind::kGeocentric) frame.up = Vec3d::UnitZ();
    frame.metres_per_unit = crs.metres_per_unit;
    frame.crs = crs.name;
    frame.from_above = !frame.up.isZero() && isAirborne(sink, crs);
    setWorldFrame(sink, source, frame);
    if (crs.kind != LasCrs::Kind::kGeographic) return;
    if (!sink.scales_degrees) addNote(sink.cloud, source.name, "is in degrees: x and y are not as long as z");
    ++sink.files_in_degrees;
}

void addBlock(const Source& source, const LasBlock& block, Sink& sink) {
    std::vector<const char*> columns;
    for (const std::vector<char>& values : block.values) columns.push_back(values.data());
    addVertices(sink, block.positions, columns);
    letGo(source, block.done_bytes);
}

/// Reads the points with all of their attributes, and what header and records say of the frame. Of a COPC file only
/// nodes that reach into the filter's bounds and are not below the sink's level.
void readLas(const Source& source, Sink& sink) {
    LasFile file = named(source, [&] { return openLas(source.bytes); });
    const std::vector<LasField> fields = lasFields(file);
    LazLayout layout = file.header.packed ? named(source, [&] { return lazLayout(file); }) : LazLayout{};
    const std::vector<LazChunk> chunks = named(source, [&] { return chunksOf(source, file, layout, sink); });
    std::uint64_t points = 0;
    for (const LazChunk& chunk : chunks) points += chunk.points;

    const bool is_first = keptPoints(sink) == 0;
    beginScan(sink, source, traitsOf(file, fields, points));
    // what addVertices throws names no file either
    named(source, [&] {
        forLasBlocks({file, fields, std::move(layout), chunks},
                     [&](const LasBlock& block) { addBlock(source, block, sink); });
    });
    finishScan(sink, source);

    const LasCrs crs = lasCrs(file);
    tellFrame(crs, source, sink);
    const bool scaled = sink.scales_degrees && crs.kind == LasCrs::Kind::kGeographic; // once all is read
    if (is_first) sink.cloud.source_header = lasSourceHeader(file, sink.world_from_input || scaled);
    for (const std::string& note : file.notes) addNote(sink.cloud, source.name, note);
}

} // namespace

const FormatReader readers::kLas{.isStart = [](std::string_view bytes) { return bytes.starts_with("LASF"); },
                                 .read = readLas,
                                 .readsInBatches = alwaysInBatches,
                                 .knows_levels = true};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// LAS files, including LAZ and COPC.

#include <algorithm>
#include <cmath>

#include "format/pointio/bytes.h"
#include "format/pointio/las_crs.h"
#include "format/pointio/las_source_header.h"
#include "preprocess/ingest/degrees.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/input/points/las_blocks.h"
#include "preprocess/input/points/las_nodes.h"
#include "preprocess/input/points/las_salvage.h"
#include "preprocess/input/points/las_scan.h"

namespace pointrt {
namespace {

/// Runs work of format/pointio and prefixes its errors with the file's name.
template <typename Work>
auto naming(const InputFile& input, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code, fmt::format("{}: {}", input.name, error.what()));
    }
}

Scalar scalarOf(std::uint32_t pro_type) { return static_cast<Scalar>(pro_type - 1); }

} // namespace

ScanTraits lasTraits(const LasFile& file, const std::vector<LasField>& fields, std::uint64_t points) {
    ScanTraits traits;
    traits.faces = false;
    for (const LasField& field : fields) {
        ColumnTraits column{field.name, scalarOf(field.type), field.components};
        column.minor = field.minor;
        traits.withholds = traits.withholds || (field.name == kWithheld && !field.extra);
        traits.columns.push_back(column);
        if (field.name != kRgb16 || field.extra) continue;
        traits.colors = true;
        traits.color_scale = ColorScale::k16Bit;
    }
    // A few bytes of a LAZ file may declare any number of points: reserve no more than is plausible for its size.
    const std::uint64_t plausible = file.bytes.size() - file.header.point_offset;
    traits.vertices = std::min(points, plausible);
    return traits;
}

namespace {

/// Keeps the beginning of each chunk. Points are unpacked one after the other, so the rest of the chunk takes no time.
void skimChunks(std::vector<LazChunk>& chunks, double share) {
    for (LazChunk& chunk : chunks)
        chunk.points = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(chunk.points)));
}

/// The chunks to read: all of them, unless the file is COPC.
std::vector<LazChunk> chunksOf(const InputFile& input, const LasFile& file, const LazLayout& layout, Sink& sink) {
    const bool selects = sink.level || sink.filter.options().bounds;
    if (sink.level && !isCopc(file)) noteWithoutLevels(input, sink);
    std::vector<LazChunk> chunks = selects && isCopc(file) ? selectedNodes(file, sink) : allLasChunks(file, layout);
    if (sink.skim < 1 && file.header.packed && !layout.in_one_run) skimChunks(chunks, sink.skim);
    return chunks;
}

/// Airborne scans see every surface from above. A scan whose box is this much wider than high, and this wide in metres,
/// is taken to be airborne.
bool isAirborne(const Sink& sink, const LasCrs& crs) {
    constexpr double kFlat = 2, kWide = 50;
    const ScanBox box = sink.lastScanBox();
    Vec3d size = box.size;
    if (crs.kind == LasCrs::Kind::kGeographic)
        size.head<2>() = size.head<2>().cwiseProduct(metresPerDegree(box.center.y()));
    const double width = size.head<2>().maxCoeff();
    return width > kFlat * size.z() && width * (crs.metres_per_unit > 0 ? crs.metres_per_unit : 1) > kWide;
}

} // namespace

/// Up is z in all coordinate systems of LAS files but geocentric ones. Without a coordinate system that is only a
/// convention: programs also export rooms in the y-up frame of a phone or a game.
void setLasFrame(const LasCrs& crs, const InputFile& input, Sink& sink) {
    WorldFrame frame;
    if (crs.kind != LasCrs::Kind::kGeocentric) frame.up = Vec3d::UnitZ();
    frame.up_by_custom = crs.name.empty() && crs.kind != LasCrs::Kind::kGeographic;
    frame.metres_per_unit = crs.metres_per_unit;
    frame.crs = crs.name;
    frame.from_above = !frame.up.isZero() && isAirborne(sink, crs);
    sink.setWorldFrame(input, frame);
    if (crs.kind == LasCrs::Kind::kGeographic) sink.addDegrees(input);
}

namespace {

void addBlock(const InputFile& input, const LasBlock& block, Sink& sink) {
    std::vector<const char*> columns;
    for (const std::vector<char>& values : block.values) columns.push_back(values.data());
    sink.addVertices(block.positions, columns);
    releasePages(input, block.done_bytes);
}

} // namespace

namespace {

std::uint64_t pointsIn(const std::vector<LazChunk>& chunks) {
    std::uint64_t points = 0;
    for (const LazChunk& chunk : chunks) points += chunk.points;
    return points;
}

std::string salvageHint(std::uint64_t whole, std::uint64_t promised) {
    return whole > 0 ? fmt::format("; {} of {} points are intact: --salvage reads these", whole, promised) : "";
}

} // namespace

void addLasPoints(const InputFile& input, LasPlan plan, Sink& sink) {
    const auto add = [&](const LasBlock& block) { addBlock(input, block, sink); };
    const std::uint64_t promised =
        isCopc(plan.file) ? pointsIn(plan.chunks) : std::max(plan.file.promised, plan.file.header.point_count);
    if (sink.salvages && plan.file.header.packed) {
        const SalvagedLas salvaged = salvageLas(plan, add);
        if (!salvaged.fault.empty() || salvaged.points < promised)
            sink.acceptShort(input, salvaged.points, promised, salvaged.fault.empty() ? "truncated" : salvaged.fault);
        return;
    }
    // errors of addVertices do not name the file either
    naming(input, [&] {
        try {
            forLasBlocks(plan, add);
        } catch (const Error& error) {
            if (error.code != ExitCode::kBadInput || !plan.file.header.packed) throw;
            const std::uint64_t whole = salvageLas(plan, [](const LasBlock&) {}).points;
            throw Error(error.code, fmt::format("{}{}", error.what(), salvageHint(whole, promised)));
        }
    });
    if (plan.file.promised > 0) sink.acceptShort(input, plan.file.header.point_count, promised);
}

LasFile openLasInput(const InputFile& input, const Sink& sink) {
    return naming(input, [&] { return openLas(input.bytes, sink.salvages); });
}

LazLayout layoutOfLas(const InputFile& input, const LasFile& file, const Sink& sink) {
    return file.header.packed ? naming(input, [&] { return lazLayout(file, sink.salvages); }) : LazLayout{};
}

std::vector<LazChunk> allLasChunks(const LasFile& file, const LazLayout& layout) {
    if (file.header.packed) return layout.chunks;
    return {{file.header.point_offset, file.header.point_count * file.header.record_bytes, file.header.point_count}};
}

namespace {

/// Whether both size and bounds contradict the header of uncompressed points: a transfer that converted line ends
/// shifts all bytes after them. If only one contradicts it, the header may just be wrong.
bool isBeyondHeader(const LasFile& file, const Sink& sink) {
    const LasHeader& header = file.header;
    const std::uint64_t end = header.point_offset + header.point_count * header.record_bytes;
    const bool fits = file.promised == 0 && (file.bytes.size() == end || header.evlr_count > 0);
    if (header.packed || fits || sink.transform.world_from_input) return false;
    constexpr std::size_t kMaxX = 179; // then min x, max y, min y, max z, min z
    const ScanBox box = sink.lastScanBox();
    // coordinates decoded from arbitrary bytes: no valid scan uses more than half of the range of 32 bits along all
    // axes
    constexpr double kHalfOfAll = 2147483648.0;
    if ((box.size.array() > kHalfOfAll * Eigen::Map<const Eigen::Array3d>(header.scale.data()).abs()).all())
        return true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto high = loadAt<double>(file.bytes, kMaxX + 16 * axis),
                   low = loadAt<double>(file.bytes, kMaxX + 8 + 16 * axis);
        const auto a = static_cast<Eigen::Index>(axis);
        const double beyond = std::max(low - (box.center[a] - box.size[a] / 2), box.center[a] + box.size[a] / 2 - high);
        if (low < high && beyond > high - low) return true;
    }
    return false;
}

/// Reads the points with all their attributes, and the coordinate frame from the header and the variable-length
/// records. In a COPC file, reads only octree nodes that overlap the filter's bounds and are no finer than the sink's
/// level.
void readLas(const InputFile& input, Sink& sink) {
    LasFile file = openLasInput(input, sink);
    const std::vector<LasField> fields = lasFields(file);
    LazLayout layout = layoutOfLas(input, file, sink);
    const std::vector<LazChunk> chunks = naming(input, [&] { return chunksOf(input, file, layout, sink); });
    const std::uint64_t points = pointsIn(chunks);
    const bool is_first = sink.pointCount() == 0;
    sink.beginScan(input, lasTraits(file, fields, points));
    addLasPoints(input, {file, fields, std::move(layout), chunks}, sink);
    sink.finishScan(input);

    if (isBeyondHeader(file, sink))
        sink.note(input,
                  "has points far outside the bounds in its header, and its size is not what the header states: it may "
                  "have been damaged by a transfer in text mode");
    const LasCrs crs = lasCrs(file);
    setLasFrame(crs, input, sink);
    const bool will_be_scaled =
        sink.scales_degrees && crs.kind == LasCrs::Kind::kGeographic; // once all files have been read
    if (is_first) sink.cloud.source_header = lasSourceHeader(file, sink.transform.world_from_input || will_be_scaled);
    for (const std::string& note : file.notes) sink.note(input, note);
}

} // namespace

const FormatReader readers::kLas{.isStart = [](std::string_view bytes) { return bytes.starts_with("LASF"); },
                                 .read = readLas,
                                 .readsInBatches = alwaysInBatches,
                                 .has_levels = true};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/read.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "preprocess/ingest/degrees.h"
#include "preprocess/ingest/notes.h"
#include "preprocess/ingest/sink.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/mesh/mesh.h"
#include "preprocess/input/scan_checks.h"

namespace pointrt {
namespace {

FileReport readFile(const std::string& path, const ReadOptions& options, Sink& sink) {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t points_before = sink.cloud.points_read, kept_before = sink.pointCount(),
                      scans_before = sink.scans.size();
    const InputFile input = openInputFile(path);
    const InputFormat& format = formatOf(input, options.format);
    const std::size_t known_before = sink.files_in_degrees + sink.files_with_crs;
    sink.points_promised = 0;
    readInput(format, input, sink);
    FileReport report{input.name, std::string(format.title)};
    report.promised = sink.points_promised;
    report.points = sink.cloud.points_read - points_before;
    report.kept = sink.pointCount() - kept_before;
    report.scans = sink.scans.size() - scans_before;
    report.hides_frame = mayHideDegrees(format.name) && sink.files_in_degrees + sink.files_with_crs == known_before;
    report.meshes = static_cast<std::uint64_t>(
        std::count_if(sink.scans.begin() + static_cast<std::ptrdiff_t>(scans_before), sink.scans.end(),
                      [](const ScanRange& scan) { return scan.has_faces; }));
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

std::vector<FileReport> readFiles(const std::vector<std::string>& paths, const ReadOptions& options,
                                  const ReadProgress& progress, Sink& sink) {
    std::vector<FileReport> files;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (progress)
            sink.progress = [&, i](double share) {
                const double done = (static_cast<double>(i) + share) / static_cast<double>(paths.size());
                progress({done, i, paths.size(), sink.cloud.points_read + sink.vertexCount()});
            };
        files.push_back(readFile(paths[i], options, sink));
    }
    if (progress) progress({1, paths.size() - 1, paths.size(), sink.cloud.points_read});
    return files;
}

void checkSampling(const ReadOptions& options, const Sink& sink) {
    const std::uint64_t count = options.sample_count.value_or(0);
    if (count == 0) return;
    if (sink.cloud.triangles.empty()) refuseSampling(sink.scans.front().name);
    if (count >= kNoSensor - sink.cloud.positions.size())
        throw Error(ExitCode::kBadUsage, fmt::format("cannot take as many as {} samples", count));
}

/// Some programs write normals that are all zero.
void dropEmptyNormals(Cloud& cloud) {
    const bool empty =
        std::all_of(cloud.normals.begin(), cloud.normals.end(), [](const Vec3f& n) { return n.isZero(0); });
    if (empty) cloud.normals = {};
}

/// sampled: by scan; the reports have the number of scans of each file
void addSampleCounts(const std::vector<std::uint64_t>& sampled, std::vector<FileReport>& files) {
    auto scan = sampled.begin();
    for (FileReport& file : files)
        for (std::uint64_t i = 0; i < file.scans; ++i) file.sampled += *scan++;
}

/// Adds an attribute with the scan number of each point.
template <typename Number>
void numberScansAs(Scalar type, Cloud& cloud, const std::vector<ScanRange>& scans) {
    Attribute numbers{kScanNumber, type, 1, std::vector<char>(cloud.positions.size() * sizeof(Number))};
    for (std::size_t scan = 0; scan < scans.size(); ++scan)
        for (std::size_t i = 0; i < scans[scan].position_count; ++i) {
            const auto number = static_cast<Number>(scan);
            std::memcpy(numbers.values.data() + (scans[scan].first_position + i) * sizeof number, &number,
                        sizeof number);
        }
    cloud.attributes.push_back(std::move(numbers));
}

void numberScans(Cloud& cloud, Columns& columns, const std::vector<ScanRange>& scans, const AttributeChoice& choice) {
    if (scans.size() > 1) columns.available.push_back(kScanNumber);
    const bool exists = std::any_of(cloud.attributes.begin(), cloud.attributes.end(),
                                    [](const Attribute& each) { return each.name == kScanNumber; });
    if (scans.size() < 2 || exists || !choice.selects(kScanNumber)) return;
    if (scans.size() <= 0x100) return numberScansAs<std::uint8_t>(Scalar::kU8, cloud, scans);
    if (scans.size() <= 0x10000) return numberScansAs<std::uint16_t>(Scalar::kU16, cloud, scans);
    numberScansAs<std::uint32_t>(Scalar::kU32, cloud, scans);
}

/// If all files are in degrees, scales these, whose unit differs from that of heights.
void scaleDegreesOfFiles(std::size_t file_count, Sink& sink) {
    if (!sink.scales_degrees || sink.files_in_degrees == 0) return;
    const std::string& file = sink.scans.front().name;
    if (sink.files_in_degrees == file_count)
        scaleDegrees(sink.cloud, file);
    else
        addNote(sink.cloud, file,
                "is one of several files, only some of which are in degrees: their coordinates do not match");
}

/// Files without a coordinate system whose x and y look like degrees count as files in degrees.
void findDegrees(const std::vector<FileReport>& files, Sink& sink) {
    std::span<const ScanRange> rest = sink.scans;
    for (const FileReport& file : files) {
        const std::span<const ScanRange> scans = rest.first(file.scans);
        rest = rest.subspan(file.scans);
        if (!file.hides_frame || !looksLikeDegrees(sink.cloud, scans)) continue;
        addNote(sink.cloud, file.name,
                "names no coordinate system, but x and y look like degrees of longitude and latitude");
        sink.files_in_degrees += 1;
    }
}

} // namespace

bool mayHideDegrees(std::string_view format) {
    return format == "las" || format == "xyz" || format == "ply" || format == "pcd" || format == "grid";
}

bool areMeshes(const std::vector<FileReport>& files) {
    return !files.empty() && std::all_of(files.begin(), files.end(), [](const FileReport& file) {
        return file.scans > 0 && file.meshes == file.scans;
    });
}

SinkOptions sinkOptions(const ReadOptions& options) {
    SinkOptions result;
    result.attributes = options.attributes;
    result.filter = options.filter;
    result.world_from_input = options.transform;
    result.level = options.level;
    result.skim = options.skim;
    result.salvages = options.salvages;
    result.drops_withheld = options.drops_withheld;
    result.gaussians_as_discs = options.gaussians_as_discs;
    result.scales_degrees = options.scales_degrees && !options.transform;
    return result;
}

Cloud readInputs(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress,
                 std::vector<FileReport>* files) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "no input file");
    Cloud cloud;
    Sink sink(cloud, sinkOptions(options));
    std::vector<FileReport> reports = readFiles(paths, options, progress, sink);
    dropNoData(sink);
    findDegrees(reports, sink);
    noteUnits(sink);
    narrowAttributes(cloud, sink.columns);
    dropMinorAttributes(cloud, sink.columns);
    numberScans(cloud, sink.columns, sink.scans, options.attributes);
    requireAvailable(sink.columns, options.attributes);
    checkSampling(options, sink);
    scaleDegreesOfFiles(paths.size(), sink);
    addMeshNormals(cloud);
    const MeshSampling sampling = chooseSampling(cloud, sink.scans, options.sample_count, sink.paint);
    dropUnused(cloud, sink.scans, sink.cornersOfRemovedFaces(), sampling.scans);
    paintVertices(sink.paint, cloud);
    const std::vector<std::uint64_t> sampled = sampleMeshes(cloud, sink.scans, sampling, options.seed, sink.paint);
    addSampleCounts(sampled, reports);
    if (files) *files = std::move(reports);
    dropEmptyNormals(cloud);
    return cloud;
}

} // namespace pointrt

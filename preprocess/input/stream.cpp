// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/stream.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>
#include <utility>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/ingest/notes.h"
#include "preprocess/ingest/sink.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/mesh/mesh.h"
#include "preprocess/input/scan_checks.h"

namespace pointrt {
namespace {

BatchOptions batchOptions(const StreamOptions& options, const std::function<void(const PointBatch&)>& take) {
    return {options.batch_points, take, options.first_pass ? &options.first_pass->largest_color : nullptr,
            options.start.kept, options.most_in_grid};
}

/// The state of one pass over the files.
struct Stream {
    const StreamOptions& options;
    Cloud cloud;
    Sink sink;
    std::vector<FileReport> files;

    Stream(const StreamOptions& of, const std::function<void(const PointBatch&)>& take)
        : options(of), sink(cloud, sinkOptions(of.read), batchOptions(of, take)) {
        sink.filter.resumeAfter(options.start.seen);
        sink.scans.resize(options.start.scan);
        if (options.first_pass) useTypes(options.first_pass->cloud.attributes);
        for (const StreamNoData& each : options.no_data)
            sink.known_no_data.push_back({each.scan, each.points, Eigen::Affine3d::Identity()});
    }

    void useTypes(const std::vector<Attribute>& attributes) {
        cloud.attributes = attributes;
        sink.attributes = {false, {}};
        for (const Attribute& attribute : attributes) sink.attributes.names.push_back(attribute.name);
    }
};

/// Sends the points of a cloud, which are already filtered and transformed and have no missing data, through the sink.
class Replay {
public:
    Replay(const Cloud& points, const std::string& name, Sink& sink) : points_(points), sink_(sink) {
        input_.name = name;
    }

    void run() {
        const auto filter = std::exchange(sink_.filter, PointFilter({}));
        const auto transform = std::exchange(sink_.transform.world_from_input, std::nullopt);
        sink_.finds_no_data = false;
        for (std::size_t scan = 0; scan < points_.scans.size(); ++scan) addScan(scan);
        sink_.finds_no_data = true;
        for (const Note& note : points_.notes) addNote(sink_.cloud, note.file, note.text);
        sink_.setWorldFrame(input_, points_.world);
        Cloud& cloud = sink_.cloud;
        cloud.points_read += points_.points_read;
        cloud.points_read -= std::min(cloud.points_read, points_.positions.size()); // the sink counts these
        cloud.points_non_finite += points_.points_non_finite;
        cloud.points_unused += points_.points_unused;
        cloud.points_filtered += points_.points_filtered;
        cloud.points_no_data += points_.points_no_data;
        cloud.points_withheld += points_.points_withheld;
        sink_.filter = filter;
        sink_.transform.world_from_input = transform;
    }

private:
    ScanTraits traits() const {
        ScanTraits traits;
        traits.normals = !points_.normals.empty();
        traits.normal_sides = points_.normal_sides;
        traits.colors = !points_.colors.empty();
        traits.radii = !points_.radii.empty();
        traits.faces = false;
        const bool has_gaussians = gaussianColumns(points_).has_value();
        for (const Attribute& each : points_.attributes)
            traits.columns.push_back({.name = each.name,
                                      .type = each.type,
                                      .components = each.components,
                                      .required = has_gaussians && isGaussianAttribute(each.name)});
        return traits;
    }

    void addScan(std::size_t scan) {
        const std::size_t first = points_.scans[scan].first_point;
        const std::size_t end =
            scan + 1 < points_.scans.size() ? points_.scans[scan + 1].first_point : points_.positions.size();
        ScanTraits all = traits();
        all.vertices = end - first;
        sink_.beginScan(input_, all);
        sink_.setScanSensor(points_.scans[scan].sensor);
        const auto grid = std::find_if(points_.grids.begin(), points_.grids.end(),
                                       [&](const RangeGrid& each) { return each.scan == scan; });
        if (grid != points_.grids.end()) beginGrid(sink_, grid->rows, grid->columns);
        std::vector<char> values;
        std::vector<std::uint32_t> vertices;
        for (std::size_t i = first; i < end; ++i) vertices.push_back(addPoint(i, values));
        if (grid != points_.grids.end()) addCells(*grid, first, vertices);
        sink_.finishScan(input_, "", Emptiness::kAllowed);
        sink_.cloud.scans.back().name = points_.scans[scan].name;
    }

    /// @param vertices those of the scan's points, from first on, as addVertex returned them
    void addCells(const RangeGrid& grid, std::size_t first, const std::vector<std::uint32_t>& vertices) {
        for (std::uint32_t row = 0; row < grid.rows; ++row)
            for (std::uint32_t column = 0; column < grid.columns; ++column) {
                const std::uint32_t cell = grid.at(row, column);
                setCell(sink_, row, column, cell < RangeGrid::kFilteredOut ? vertices[cell - first] : cell);
            }
    }

    std::uint32_t addPoint(std::size_t i, std::vector<char>& values) {
        Row row{};
        const Vec3d position = points_.origin + points_.positions[i].cast<double>();
        for (int axis = 0; axis < 3; ++axis) {
            row[kX + axis] = position[axis];
            if (!points_.normals.empty()) row[kNormalX + axis] = double(points_.normals[i][axis]);
            if (!points_.colors.empty()) row[kRed + axis] = points_.colors[i][static_cast<std::size_t>(axis)];
        }
        if (!points_.radii.empty()) row[kRadius] = double(points_.radii[i]);
        values.clear();
        for (const Attribute& each : points_.attributes) {
            const char* const from = each.values.data() + i * each.bytesEach();
            values.insert(values.end(), from, from + each.bytesEach());
        }
        return sink_.addVertex(row, values.data());
    }

    const Cloud& points_;
    Sink& sink_;
    InputFile input_;
};

/// Throws Error if a file whose bytes must all be in memory is too large.
void requireSmall(const InputFile& input, const Stream& stream, const char* why) {
    if (input.bytes.size() > stream.options.largest_whole_file)
        refuse(input,
               fmt::format("{}: its {} MB exceed the limit; raise --max-memory", why, input.bytes.size() / 1'000'000));
}

/// Reads a file as a bake of this file alone does.
FileReport readWhole(const InputFile& input, const std::string& path, Stream& stream) {
    requireSmall(input, stream, "must be read at once (it has faces, grids or compressed points)");
    std::vector<FileReport> reports;
    Cloud points = readInputs({path}, stream.options.read, {}, &reports);
    points.attributes.erase(std::remove_if(points.attributes.begin(), points.attributes.end(),
                                           [](const Attribute& each) { return each.name == kScanNumber; }),
                            points.attributes.end()); // attributes are numbered over all files
    Replay(points, input.name, stream.sink).run();
    return reports.front();
}

FileReport readStreamed(const InputFile& input, const InputFormat& format, Stream& stream) {
    Sink& sink = stream.sink;
    const std::size_t read_before = sink.cloud.points_read, scans_before = sink.scans.size();
    const std::uint64_t kept_before = sink.pointCount();
    sink.points_promised = 0;
    readInput(format, input, sink);
    FileReport report{input.name, std::string(format.title)};
    report.promised = sink.points_promised;
    report.points = sink.cloud.points_read - read_before;
    report.kept = sink.pointCount() - kept_before;
    report.scans = sink.scans.size() - scans_before;
    return report;
}

void readFile(const std::string& path, Stream& stream) {
    const auto start = std::chrono::steady_clock::now();
    const InputFile input = openInputFile(path);
    if (!input.mapped) requireSmall(input, stream, "must be unpacked in memory");
    const InputFormat& format = formatOf(input, stream.options.read.format);
    const std::size_t known_before = stream.sink.files_in_degrees + stream.sink.files_with_crs;
    const bool streams = format.reader.readsInBatches && format.reader.readsInBatches(input);
    if (streams && stream.options.read.sample_count.value_or(0) > 0) refuseSampling(input.name);
    FileReport report = streams ? readStreamed(input, format, stream) : readWhole(input, path, stream);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (stream.sink.scales_degrees && stream.sink.files_in_degrees > 0)
        refuse(input, "is in degrees of longitude and latitude, which tile sets do not support; convert to metres with "
                      "--transform");
    const ScanBox box = stream.sink.lastScanBox();
    const bool hides_frame = streams && mayHideDegrees(format.name) &&
                             stream.sink.files_in_degrees + stream.sink.files_with_crs == known_before;
    if (hides_frame && looksLikeDegrees({box.center - box.size / 2, box.center + box.size / 2}))
        stream.sink.note(input, "names no coordinate system, but x and y look like degrees of longitude and latitude: "
                                "tile sets do not convert them");
    stream.files.push_back(report);
}

StreamFindings findingsOf(Stream&& stream) {
    StreamFindings findings;
    findings.untyped = stream.sink.columns.untyped;
    findings.minor = stream.sink.columns.minor;
    findings.largest_color = stream.sink.batchFindings().largest_color;
    findings.colors = stream.sink.batchFindings().colors;
    for (const ScanNoData& each : stream.sink.no_data) findings.no_data.push_back({each.scan, each.points});
    for (const ScanRange& scan : stream.sink.scans) findings.scan_points.push_back(scan.position_count);
    findings.files = std::move(stream.files);
    removePoints(stream.cloud);
    findings.cloud = std::move(stream.cloud);
    return findings;
}

} // namespace

StreamFindings readInBatches(const std::vector<std::string>& paths, const StreamOptions& options,
                             const std::function<void(const PointBatch&)>& take, const ReadProgress& progress) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "no input file");
    Stream stream(options, take);
    Sink& sink = stream.sink;
    for (std::size_t i = options.start.file; i < paths.size(); ++i) {
        if (progress)
            sink.progress = [&, i](double share) {
                const double done = (static_cast<double>(i) + share) / static_cast<double>(paths.size());
                progress({done, i, paths.size(), sink.cloud.points_read + sink.vertexCount()});
            };
        readFile(paths[i], stream);
        if (options.file_done) options.file_done({i + 1, sink.scans.size(), sink.pointCount(), sink.filter.seen()});
    }
    if (progress) progress({1, paths.size() - 1, paths.size(), sink.cloud.points_read});
    if (!options.first_pass) {
        if (sink.scans.size() > 1) sink.columns.available.emplace_back(kScanNumber);
        requireAvailable(sink.columns, options.read.attributes);
    }
    return findingsOf(std::move(stream));
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/stream.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>
#include <utility>

#include "preprocess/input/detect.h"
#include "preprocess/input/mesh.h"
#include "preprocess/input/sink.h"

namespace pointrt {
namespace {

/// Everything of one reading.
struct Stream {
    const StreamOptions& options;
    Cloud cloud;
    Batches batches;
    Sink sink{cloud};
    std::vector<FileReport> files;

    Stream(const StreamOptions& of, const std::function<void(const PointBatch&)>& take) : options(of) {
        batches.points = options.batch_points;
        batches.take = take;
        batches.handed_on = options.start.kept;
        sink.batches = &batches;
        sink.attributes = options.read.attributes;
        sink.filter = PointFilter(options.read.filter);
        sink.filter.goOnFrom(options.start.seen);
        sink.world_from_input = options.read.transform;
        sink.level = options.read.level;
        sink.scales_degrees = options.read.scales_degrees && !options.read.transform;
        sink.scans.resize(options.start.scan);
        if (options.known) useKnown(*options.known);
    }

    void useKnown(const StreamFindings& known) {
        batches.scales_known = true;
        batches.largest_color = known.largest_color;
        cloud.attributes = known.cloud.attributes;
        sink.attributes = {false, {}};
        for (const Attribute& attribute : cloud.attributes) sink.attributes.names.push_back(attribute.name);
    }
};

/// Puts points that stand in a cloud of their own through the sink: what filters and places them is done.
class Replay {
public:
    Replay(const Cloud& points, const std::string& name, Sink& sink) : points_(points), sink_(sink) {
        source_.name = name;
    }

    void run() {
        const auto filter = std::exchange(sink_.filter, PointFilter({}));
        const auto placed = std::exchange(sink_.world_from_input, std::nullopt);
        for (std::size_t scan = 0; scan < points_.scans.size(); ++scan) addScan(scan);
        for (const Note& note : points_.notes) addNote(sink_.cloud, note.file, note.text);
        setWorldFrame(sink_, source_, points_.world);
        Cloud& cloud = sink_.cloud;
        cloud.points_read += points_.points_read;
        cloud.points_read -= std::min(cloud.points_read, points_.positions.size()); // which the sink counted
        cloud.points_non_finite += points_.points_non_finite;
        cloud.points_unused += points_.points_unused;
        cloud.points_filtered += points_.points_filtered;
        sink_.filter = filter;
        sink_.world_from_input = placed;
    }

private:
    ScanTraits traits() const {
        ScanTraits traits;
        traits.normals = !points_.normals.empty();
        traits.normal_sides = points_.normal_sides;
        traits.colors = !points_.colors.empty();
        traits.radii = !points_.radii.empty();
        traits.faces = false;
        for (const Attribute& each : points_.attributes)
            traits.columns.push_back({each.name, each.type, each.components});
        return traits;
    }

    void addScan(std::size_t scan) {
        const std::size_t first = points_.scans[scan].first_point;
        const std::size_t end =
            scan + 1 < points_.scans.size() ? points_.scans[scan + 1].first_point : points_.positions.size();
        ScanTraits all = traits();
        all.vertices = end - first;
        beginScan(sink_, source_, all);
        std::vector<char> values;
        for (std::size_t i = first; i < end; ++i) addPoint(i, values);
        finishScan(sink_, source_, "", Emptiness::kAllowed);
        sink_.cloud.scans.back().name = points_.scans[scan].name;
        sink_.cloud.scans.back().sensor = points_.scans[scan].sensor;
    }

    void addPoint(std::size_t i, std::vector<char>& values) {
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
        addVertex(sink_, row, values.data());
    }

    const Cloud& points_;
    Sink& sink_;
    Source source_;
};

/// Bytes that all have to be in memory.
void requireSmall(const Source& source, const Stream& stream, const char* why) {
    if (source.bytes.size() > stream.options.largest_whole_file)
        refuse(source, fmt::format("{}, for which its {} MB are too many: a larger --max-memory allows it", why,
                                   source.bytes.size() / 1'000'000));
}

/// The file by itself, as a bake of it alone reads it.
FileReport readWhole(const Source& source, const std::string& path, Stream& stream) {
    requireSmall(source, stream, "is read as a whole, as faces, grids and packed points are");
    std::vector<FileReport> reports;
    Cloud points = readInputs({path}, stream.options.read, {}, &reports);
    points.attributes.erase(std::remove_if(points.attributes.begin(), points.attributes.end(),
                                           [](const Attribute& each) { return each.name == kScanNumber; }),
                            points.attributes.end()); // numbered anew among all files
    Replay(points, source.name, stream.sink).run();
    return reports.front();
}

FileReport readStreamed(const Source& source, const InputFormat& format, Stream& stream) {
    Sink& sink = stream.sink;
    const std::size_t read_before = sink.cloud.points_read, scans_before = sink.scans.size();
    const std::uint64_t kept_before = keptPoints(sink);
    readSource(format, source, sink);
    FileReport report{source.name, std::string(format.title)};
    report.points = sink.cloud.points_read - read_before;
    report.kept = keptPoints(sink) - kept_before;
    report.scans = sink.scans.size() - scans_before;
    return report;
}

void readFile(const std::string& path, Stream& stream) {
    const auto start = std::chrono::steady_clock::now();
    const Source source = openSource(path);
    if (!source.mapped) requireSmall(source, stream, "is unpacked as a whole, as .gz files are");
    const InputFormat& format = formatOf(source, stream.options.read.format);
    const bool streams = format.reader.readsInBatches && format.reader.readsInBatches(source);
    if (streams && stream.options.read.sample_count.value_or(0) > 0) refuseSampling(source.name);
    FileReport report = streams ? readStreamed(source, format, stream) : readWhole(source, path, stream);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (stream.sink.scales_degrees && stream.sink.files_in_degrees > 0)
        refuse(source, "is in degrees of longitude and latitude, which tile sets do not take: --transform makes metres "
                       "of them");
    stream.files.push_back(report);
}

StreamFindings findingsOf(Stream&& stream) {
    StreamFindings findings;
    findings.loose = stream.sink.columns.loose;
    findings.minor = stream.sink.columns.minor;
    findings.largest_color = std::move(stream.batches.largest_color);
    findings.colors = stream.batches.colors;
    for (const ScanRange& scan : stream.sink.scans) findings.scan_points.push_back(scan.position_count);
    findings.files = std::move(stream.files);
    stream.batches.empty(stream.cloud);
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
                progress({done, i, paths.size(), sink.cloud.points_read + sink.vertices});
            };
        readFile(paths[i], stream);
        if (options.file_done) options.file_done({i + 1, sink.scans.size(), keptPoints(sink), sink.filter.seen()});
    }
    if (progress) progress({1, paths.size() - 1, paths.size(), sink.cloud.points_read});
    if (!options.known) {
        if (sink.scans.size() > 1) sink.columns.offered.emplace_back(kScanNumber);
        requireOffered(sink.columns, options.read.attributes);
    }
    return findingsOf(std::move(stream));
}

} // namespace pointrt

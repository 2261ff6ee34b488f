// SPDX-License-Identifier: Apache-2.0
// Reads scans as a bake does and prints the result: points, extents, attributes and seconds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "preprocess/ingest/scalar.h"
#include "preprocess/input/read.h"
#include "tests/bench/compare_options.h"

namespace pointrt::test {
namespace {

using Json = nlohmann::ordered_json;

/// Statistics of the finite numbers.
struct Range {
    double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;
    std::uint64_t others = 0; ///< number of values that are not finite

    void add(double value) {
        if (!std::isfinite(value)) {
            ++others;
            return;
        }
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
    }
};

Json jsonOf(const Range& range) {
    if (range.least > range.most) return {{"not_finite", range.others}};
    return {{"min", range.least}, {"max", range.most}, {"sum", range.sum}, {"not_finite", range.others}};
}

Json positionsOf(const Cloud& cloud) {
    std::array<Range, 3> ranges;
    for (const Vec3f& position : cloud.positions)
        for (int axis = 0; axis < 3; ++axis) ranges[axis].add(cloud.origin[axis] + double(position[axis]));
    return {jsonOf(ranges[0]), jsonOf(ranges[1]), jsonOf(ranges[2])};
}

Json colorsOf(const Cloud& cloud) {
    if (cloud.colors.empty()) return nullptr;
    std::array<Range, 3> ranges;
    for (const Rgb8& color : cloud.colors)
        for (int channel = 0; channel < 3; ++channel) ranges[channel].add(color[channel]);
    return {jsonOf(ranges[0]), jsonOf(ranges[1]), jsonOf(ranges[2])};
}

Json attributeOf(const Attribute& attribute) {
    constexpr const char* kTypes[] = {"i8", "u8", "i16", "u16", "i32", "u32", "i64", "u64", "f32", "f64"};
    Range range;
    const std::size_t size = scalarSize(attribute.type);
    for (std::size_t at = 0; at < attribute.values.size(); at += size)
        range.add(loadScalar(attribute.values.data() + at, attribute.type, false));
    Json json = jsonOf(range);
    json["name"] = attribute.name;
    json["type"] = kTypes[static_cast<int>(attribute.type)];
    json["components"] = attribute.components;
    return json;
}

/// The minimum that a bake needs from here on.
std::uint64_t bytesOf(const Cloud& cloud) {
    std::uint64_t bytes = cloud.positions.size() * sizeof(Vec3f) + cloud.normals.size() * sizeof(Vec3f) +
                          cloud.colors.size() * sizeof(Rgb8) + cloud.radii.size() * sizeof(float) +
                          cloud.sensor_of_point.size() * sizeof(std::uint32_t) +
                          cloud.triangles.size() * sizeof(cloud.triangles[0]);
    for (const Attribute& attribute : cloud.attributes) bytes += attribute.values.size();
    return bytes;
}

Json scansOf(const Cloud& cloud) {
    Json scans = Json::array();
    for (const Scan& scan : cloud.scans) {
        Json sensor = nullptr;
        if (scan.sensor) sensor = {scan.sensor->x(), scan.sensor->y(), scan.sensor->z()};
        scans.push_back({{"name", scan.name}, {"sensor", sensor}});
    }
    return scans;
}

Json contentOf(const Cloud& cloud) {
    Json json;
    json["positions"] = positionsOf(cloud);
    json["colors"] = colorsOf(cloud);
    json["normals"] = !cloud.normals.empty();
    json["radii"] = !cloud.radii.empty();
    json["faces"] = cloud.triangles.size();
    json["attributes"] = Json::array();
    for (const Attribute& attribute : cloud.attributes) json["attributes"].push_back(attributeOf(attribute));
    json["scans"] = scansOf(cloud);
    json["up"] = {cloud.world.up.x(), cloud.world.up.y(), cloud.world.up.z()};
    json["metres_per_unit"] = cloud.world.metres_per_unit;
    json["crs"] = cloud.world.crs;
    json["notes"] = Json::array();
    for (const Note& note : cloud.notes) json["notes"].push_back(note.text);
    return json;
}

rusage usedSoFar() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

struct Request {
    std::vector<std::string> files;
    bool content = false;
};

int readScan(const Request& request) {
    std::uint64_t file_bytes = 0;
    for (const std::string& file : request.files)
        if (std::filesystem::is_regular_file(file)) file_bytes += std::filesystem::file_size(file);
    const auto start = std::chrono::steady_clock::now();
    std::vector<FileReport> files;
    const Cloud cloud = readInputs(request.files, {}, {}, &files);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const rusage used = usedSoFar();
    Json json{{"format", files.front().format},
              {"points", cloud.points_read},
              {"kept", cloud.positions.size()},
              {"not_finite", cloud.points_non_finite},
              {"unused", cloud.points_unused},
              {"seconds", took.count()},
              {"cpu_seconds", seconds(used.ru_utime) + seconds(used.ru_stime)},
              {"peak_bytes", static_cast<std::uint64_t>(used.ru_maxrss) * 1024}, // in KiB
              {"file_bytes", file_bytes}, // mapped: evictable, but part of the peak
              {"cloud_bytes", bytesOf(cloud)}};
    if (request.content) json.update(contentOf(cloud));
    // names may have any bytes
    std::cout << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt::test;
    CLI::App app("Reads scans as a bake does and prints what came of it, as JSON.", "read_scan");
    Request request;
    app.add_option("FILES", request.files, "Read into one cloud")->required();
    app.add_flag("--content", request.content, "Extents, attributes and scans too; not part of the seconds");
    return runCompare(app, argc, argv, [&] { return readScan(request); });
}

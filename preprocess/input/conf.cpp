// SPDX-License-Identifier: GPL-3.0-or-later
// The .conf files of the Stanford 3D Scanning Repository, which list scans and their poses.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "format/os/descriptor.h"
#include "preprocess/ingest/named_file.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/detect.h"

namespace pointrt {
namespace {

struct Placement {
    std::string file;
    Pose input_from_scan;
    std::string line; ///< line number
};

/// "bmesh FILE tx ty tz qx qy qz qw". The quaternions of these files rotate from world to scan.
Placement parsePlacement(const InputFile& input, std::string_view line) {
    const char* const place = line.data();
    Placement placement;
    placement.file = nextWord(line);
    if (hasControls(placement.file)) refuseLine(input, place, inQuotes(placement.file) + " is not a file name");
    double v[7] = {};
    for (double& value : v)
        if (!wholeNumber(nextWord(line), value)) refuseLine(input, place, "bmesh needs a file name and 7 numbers");
    const Eigen::Quaterniond scan_from_input(v[6], v[3], v[4], v[5]);
    const double length = scan_from_input.norm();
    if (!std::isfinite(length) || length < 1e-6) refuseLine(input, place, "the quaternion is not a rotation");
    placement.input_from_scan.linear = scan_from_input.normalized().toRotationMatrix().transpose();
    placement.input_from_scan.translation = {v[0], v[1], v[2]};
    placement.line = std::to_string(1 + std::count(input.begin(), place, '\n'));
    return placement;
}

std::vector<Placement> parsePlacements(const InputFile& input) {
    std::vector<Placement> placements;
    std::string_view rest = input.bytes, line;
    while (nextLine(rest, line))
        if (nextWord(line) == "bmesh") placements.push_back(parsePlacement(input, line));
    if (placements.empty()) refuse(input, "has no bmesh line");
    return placements;
}

namespace fs = std::filesystem;

[[noreturn]] void refuseScan(std::string_view name, const std::string& reason) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}", inQuotes(name), reason));
}

fs::path pathOf(const Placement& placement, const fs::path& folder) {
    const std::optional<fs::path> path = pathInFolder(folder, placement.file);
    if (!path) refuseScan(placement.file, "lies outside the folder of the .conf file, which must hold its scans");
    return *path;
}

/// Counts how often each file is named, under any path, and limits that: otherwise a few lines could request any amount
/// of memory. A scan usually has one place in a set; the limit leaves room for patterns and rotated copies.
struct NamedFiles {
    static constexpr int kMostTimes = 8;
    std::map<std::pair<std::uint64_t, std::uint64_t>, int> times;

    void add(const Placement& placement, const fs::path& scan) {
        const auto status = statusOf(scan.string());
        if (!status) return; // openInputFile reports why
        if (++times[{status->device, status->number}] > kMostTimes)
            refuseScan(placement.file, fmt::format("is named more than {} times", kMostTimes));
    }
};

void readScan(const Placement& placement, const fs::path& folder, NamedFiles& named, Sink& sink) {
    const fs::path path = pathOf(placement, folder);
    named.add(placement, path);
    const InputFile scan = openInputFile(path.string(), NamedBy::kFile);
    const InputFormat& format = formatOf(scan, "");
    if (&format.reader == &readers::kConf) refuse(scan, "a .conf file cannot be a scan of another");
    sink.transform.input_from_scan = placement.input_from_scan;
    format.reader.read(scan, sink);
    sink.setSensorAlongZ();
}

bool isMeshLine(std::string_view line, bool) { return nextWord(line) == "bmesh"; }

void readConf(const InputFile& input, Sink& sink) {
    const std::vector<Placement> placements = parsePlacements(input);
    const auto file_progress = sink.progress;
    NamedFiles named;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        if (file_progress)
            sink.progress = [&, i](double share) {
                file_progress((static_cast<double>(i) + share) / static_cast<double>(placements.size()));
            };
        try {
            readScan(placements[i], fs::path(input.name).parent_path(), named, sink);
        } catch (const Error& error) {
            throw Error(error.code, fmt::format("{}:{}: {}", input.name, placements[i].line, error.what()));
        }
    }
    sink.transform.input_from_scan.reset();
    sink.progress = file_progress;
}

} // namespace

const FormatReader readers::kConf{.isLine = isMeshLine, .read = readConf};

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// The .conf files of the Stanford 3D Scanning Repository: which scan lies where.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sys/stat.h>
#include <utility>

#include "preprocess/input/detect.h"
#include "preprocess/input/text.h"

namespace pointrt {
namespace {

struct Placement {
    std::string file;
    Pose world_from_scan;
    std::string line; ///< its number
};

/// "bmesh FILE tx ty tz qx qy qz qw". The quaternions of these files turn the world into the scan.
Placement parsePlacement(const Source& source, std::string_view line) {
    const char* const place = line.data();
    Placement placement;
    placement.file = nextWord(line);
    if (hasControls(placement.file)) refuseLine(source, place, inQuotes(placement.file) + " is no name of a file");
    double v[7] = {};
    for (double& value : v)
        if (!wholeNumber(nextWord(line), value)) refuseLine(source, place, "bmesh takes a file name and 7 numbers");
    const Eigen::Quaterniond scan_from_world(v[6], v[3], v[4], v[5]);
    const double length = scan_from_world.norm();
    if (!std::isfinite(length) || length < 1e-6) refuseLine(source, place, "the quaternion is no rotation");
    placement.world_from_scan.linear = scan_from_world.normalized().toRotationMatrix().transpose();
    placement.world_from_scan.translation = {v[0], v[1], v[2]};
    placement.line = std::to_string(1 + std::count(source.begin(), place, '\n'));
    return placement;
}

std::vector<Placement> parsePlacements(const Source& source) {
    std::vector<Placement> placements;
    std::string_view rest = source.bytes, line;
    while (nextLine(rest, line))
        if (nextWord(line) == "bmesh") placements.push_back(parsePlacement(source, line));
    if (placements.empty()) refuse(source, "has no bmesh line");
    return placements;
}

namespace fs = std::filesystem;

[[noreturn]] void refuseScan(std::string_view name, const std::string& reason) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}", inQuotes(name), reason));
}

/// A set is its folder: the .conf of a stranger must not pick what else is on this machine, by any road, and show it
/// in the scene or in a message.
void requireInFolder(const Placement& placement, const fs::path& folder) {
    std::error_code failure;
    const fs::path root = fs::canonical(folder.empty() ? "." : folder, failure);
    const fs::path real = failure ? fs::path() : fs::weakly_canonical(root / placement.file, failure);
    const bool inside =
        !failure && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
    if (!inside) refuseScan(placement.file, "lies outside the folder of the .conf; its scans are there or below");
}

/// How often each file has been named, by whatever name. A scan has one place in a set; the few times more are for
/// patterns and copies turned round by hand. Without an end to it a few lines would ask for any amount of memory.
struct NamedFiles {
    static constexpr int kMostTimes = 8;
    std::map<std::pair<dev_t, ino_t>, int> times;

    void add(const Placement& placement, const fs::path& scan) {
        struct stat status {};
        if (::stat(scan.c_str(), &status) != 0) return; // opening it says why
        if (++times[{status.st_dev, status.st_ino}] > kMostTimes)
            refuseScan(placement.file, fmt::format("is named more than {} times", kMostTimes));
    }
};

void readScan(const Placement& placement, const fs::path& folder, NamedFiles& named, Sink& sink) {
    const fs::path path = folder / placement.file;
    requireInFolder(placement, folder);
    named.add(placement, path);
    const Source scan = openSource(path.string(), NamedBy::kFile);
    const InputFormat& format = formatOf(scan, "");
    if (&format.reader == &readers::kConf) refuse(scan, "a .conf file cannot be a scan of another");
    sink.world_from_scan = placement.world_from_scan;
    format.reader.read(scan, sink);
    setSensorAlongZ(sink);
}

bool isMeshLine(std::string_view line, bool) { return nextWord(line) == "bmesh"; }

void readConf(const Source& source, Sink& sink) {
    const std::vector<Placement> placements = parsePlacements(source);
    const auto whole_progress = sink.progress;
    NamedFiles named;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        if (whole_progress)
            sink.progress = [&, i](double share) {
                whole_progress((static_cast<double>(i) + share) / static_cast<double>(placements.size()));
            };
        try {
            readScan(placements[i], fs::path(source.name).parent_path(), named, sink);
        } catch (const Error& error) {
            throw Error(error.code, fmt::format("{}:{}: {}", source.name, placements[i].line, error.what()));
        }
    }
    sink.world_from_scan.reset();
    sink.progress = whole_progress;
}

} // namespace

const FormatReader readers::kConf{.isLine = isMeshLine, .read = readConf};

} // namespace pointrt

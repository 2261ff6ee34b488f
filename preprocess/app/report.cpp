// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/report_file.h"
#include "format/os/memory.h"
#include "format/os/separators.h"
#include "preprocess/app/vector_json.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;

Json worldJson(const WorldFrame& world) {
    return {{"up", vectorJson(world.up)}, {"metres_per_unit", world.metres_per_unit}, {"crs", world.crs}};
}

/// The world frame for META; it says how up was found if no file and no user gave it.
Json worldMetadata(const BakeReport& report) {
    Json json = worldJson(report.world);
    if (report.up_reason.empty()) return json;
    json["up_from"] = report.up_from;
    json["up_reason"] = report.up_reason;
    return json;
}

Json filesJson(const BakeReport& report) {
    Json files = Json::array();
    for (const FileReport& file : report.files)
        files.push_back({{"name", file.name},
                         {"format", file.format},
                         {"points", file.points},
                         {"kept", file.kept},
                         {"sampled", file.sampled},
                         {"scans", file.scans},
                         {"seconds", file.seconds}});
    return files;
}

/// "a/b.e57: Scan 1" as "b.e57: Scan 1".
std::string withoutFolder(const std::string& scan) {
    const std::size_t title = scan.find(": ");
    const std::size_t slash = scan.find_last_of(kFolderSeparators, title);
    return slash == std::string::npos ? scan : scan.substr(slash + 1);
}

Json cleanedJson(const BakeReport& report) {
    return {
        {"dropped", report.surface.clean_dropped}, {"moved", report.surface.clean_moved}, {"filled", report.filled}};
}

/// Whether cleaning changed the points.
bool isChanged(const BakeReport& report) {
    return report.surface.clean_dropped > 0 || report.surface.clean_moved > 0 || report.filled > 0;
}

/// The noise of each scan before cleaning, relative to its point spacing.
Json noiseJson(const BakeReport& report) {
    Json scans = Json::array();
    for (std::size_t i = 0; i < report.surface.noise.size(); ++i)
        scans.push_back({{"scan", i < report.scans.size() ? withoutFolder(report.scans[i].name) : ""},
                         {"over_spacing", report.surface.noise[i]}});
    return scans;
}

/// The truncated files, and how many of their points were read.
Json salvagedJson(const BakeReport& report) {
    Json files = Json::array();
    for (const FileReport& file : report.files)
        if (file.promised > 0)
            files.push_back({{"file", withoutFolder(file.name)}, {"points", file.points}, {"promised", file.promised}});
    return files;
}

Json attributeNames(const BakeReport& report) {
    Json names = Json::array();
    for (const Attribute& attribute : report.attributes) names.push_back(attribute.name);
    return names;
}

Json toJson(const BakeReport& report) {
    Json json;
    json["input_points"] = report.input_points;
    json["points_sampled"] = report.points_sampled;
    json["points_non_finite"] = report.points_non_finite;
    json["points_unused"] = report.points_unused;
    json["points_filtered"] = report.points_filtered;
    json["points_no_data"] = report.points_no_data;
    json["points_withheld"] = report.points_withheld;
    json["duplicates_removed"] = report.surface.duplicates_removed + report.merged;
    json["outliers_removed"] = report.surface.outliers_removed;
    json["normals_estimated"] = report.surface.normals_estimated;
    json["normals_flipped"] = report.surface.normals_flipped;
    json["splats"] = report.splats;
    if (report.gaussians > 0) json["gaussians"] = report.gaussians;
    json["nodes"] = report.octree.nodes;
    json["filled_leaves"] = report.octree.filled_leaves;
    json["border_leaves"] = report.octree.border_leaves;
    json["empty_leaves"] = report.octree.empty_leaves;
    json["max_depth"] = report.octree.max_depth;
    json["references_unpruned"] = report.references_unpruned;
    json["references"] = report.octree.references;
    json["pruning"] = {{"rounds", report.pruning.rounds},
                       {"cutoff", report.pruning.cutoff},
                       {"probes", report.pruning.probes},
                       {"harm", report.pruning.harm},
                       {"harm_bound", report.pruning.harm_bound}};
    json["up"] = vectorJson(report.world.up);
    json["up_from"] = report.up_from;
    json["up_reason"] = report.up_reason;
    json["attributes"] = attributeNames(report);
    json["noise"] = noiseJson(report);
    json["cleaned"] = cleanedJson(report);
    json["balls"] = report.balls;
    json["radii"] = {{"seen_through", report.surface.seen_through}};
    json["files"] = filesJson(report);
    if (Json salvaged = salvagedJson(report); !salvaged.empty()) json["salvaged"] = std::move(salvaged);
    json["notes"] = Json::array();
    for (const Note& note : report.notes) json["notes"].push_back(noteLine(note));
    json["bytes"] = report.octree.file_bytes;
    json["peak_rss_bytes"] = peakRssBytes();
    for (const auto& [stage, seconds] : report.seconds) json["seconds"][stage] = seconds;
    json["seconds"]["total"] = report.seconds_total;
    return json;
}

bool hasWorld(const WorldFrame& world) {
    return !world.up.isZero() || world.metres_per_unit != 0 || !world.crs.empty();
}

} // namespace

void writeStats(const BakeReport& report, const std::string& path) {
    // names need not be UTF-8
    writeReport(path, toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string noteLine(const Note& note) {
    const std::string others = note.more_files > 0 ? fmt::format(" and {} more", note.more_files) : "";
    return fmt::format("{}{}: {}", note.file, others, note.text);
}

std::string fileLine(const FileReport& file) {
    std::string line = fmt::format("{}: {}, {} points", file.name, file.format, file.points);
    if (file.kept != file.points) line += fmt::format(", {} kept", file.kept);
    if (file.sampled > 0) line += fmt::format(", {} sampled on its faces", file.sampled);
    if (file.scans != 1) line += fmt::format(", {} scans", file.scans);
    return line;
}

std::string rateText(const FileReport& file) {
    const double rate = file.seconds > 0 ? static_cast<double>(file.points) / file.seconds : 0;
    return fmt::format(", {:.2f} s, {:.2g} million points/s", file.seconds, rate / 1e6);
}

std::string metadataJson(const BakeOptions& options, const BakeReport& report) {
    Json json;
    json["writer"] = "pointrt-bake " POINTRT_VERSION;
    for (const std::string& input : options.inputs) // without folders, which are private
        json["sources"].push_back(std::filesystem::path(input).filename().string());
    for (const Scan& scan : report.scans)
        if (report.scans.size() > 1) json["scans"].push_back(withoutFolder(scan.name));
    if (hasWorld(report.world)) json["world"] = worldMetadata(report);
    if (isChanged(report)) { // a clean scan gives the same file with and without cleaning
        json["noise"] = noiseJson(report);
        json["cleaned"] = cleanedJson(report);
        json["settings"]["clean"] = options.surface.clean;
    }
    if (Json salvaged = salvagedJson(report); !salvaged.empty()) json["salvaged"] = std::move(salvaged);
    const Json header = Json::parse(report.source_header, nullptr, false);
    if (header.is_object()) json["source_header"] = header;
    Json& settings = json["settings"];
    settings["sample"] = report.points_sampled;
    settings["seed"] = options.read.seed;
    settings["neighbors"] = options.surface.neighbors;
    settings["normals"] = choiceName(options.surface.normals);
    settings["orient"] = choiceName(options.surface.orient);
    if (report.balls > 0) settings["splat"] = choiceName(options.surface.splat); // discs give the same file either way
    settings["radius_scale"] = options.surface.radius_scale;
    settings["outliers"] = options.surface.remove_outliers ? "remove" : "keep";
    settings["max_leaf_splats"] = options.octree.max_leaf_splats;
    settings["max_depth"] = options.octree.max_depth;
    settings["prune"] = options.prune;
    settings["probe_rays"] = options.pruning.probe_rays;
    settings["prune_harm"] = options.pruning.harm;
    settings["reflectivity"] = options.reflectivity;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace); // names need not be UTF-8
}

} // namespace pointrt

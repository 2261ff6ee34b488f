// SPDX-License-Identifier: Apache-2.0
#include "format/info/set_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "format/base/error.h"
#include "format/base/number_type.h"
#include "format/base/printable.h"
#include "format/info/words.h"
#include "format/pointio/metadata.h"
#include "format/set/open_tile.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;

void addTile(SetLevelSummary& sum, const SetTile& tile) {
    ++sum.tiles;
    sum.original_tiles += tile.isOriginal();
    sum.splats += tile.splats;
    sum.stored += tile.stored;
    sum.bytes += tile.bytes;
}

double medianSpacing(const TileSet& set, std::uint32_t level) {
    std::vector<double> spacings;
    for (const SetTile& tile : set.tiles)
        if (tile.level == level) spacings.push_back(tile.spacing);
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return *middle; // a valid set has tiles on each level
}

pro_world worldOf(const TileSet& set) {
    pro_world world{};
    std::transform(set.up.begin(), set.up.end(), world.up, [](double axis) { return static_cast<float>(axis); });
    world.metres_per_unit = set.metres;
    return world;
}

std::size_t knownSensors(const TileSet& set) {
    return static_cast<std::size_t>(
        std::count_if(set.sensors.begin(), set.sensors.end(), [](const auto& sensor) { return sensor[3] != 0; }));
}

double share(std::uint64_t part, std::uint64_t total) { return static_cast<double>(part) / static_cast<double>(total); }

std::string tilesText(const SetSummary& summary) {
    const std::string count =
        fmt::format("{}, {} of them with original splats", summary.all.tiles, summary.all.original_tiles);
    if (summary.damaged.empty()) return count;
    return fmt::format("{}; {} missing or different from set.json; list them with --verify", count,
                       summary.damaged.size());
}

std::string levelTable(const SetSummary& summary, const TileSet& set) {
    std::string text = fmt::format("\n{:>5} {:>12} {:>8} {:>8} {:>13} {:>13} {:>11} {:>11} {:>15}\n", "level",
                                   "core edge", "tiles", "merged", "splats", "stored", "error", "spacing", "bytes");
    for (std::uint32_t level = 0; level < summary.levels.size(); ++level) {
        const SetLevelSummary& sum = summary.levels[level];
        text += fmt::format("{:>5} {:>12.6g} {:>8} {:>8} {:>13} {:>13} {:>11.4g} {:>11.4g} {:>15}\n", level,
                            edgeOf(set, level), sum.tiles, sum.tiles - sum.original_tiles, sum.splats, sum.stored,
                            sum.error, sum.spacing, sum.bytes);
    }
    return text;
}

std::string attributeTable(const TileSet& set) {
    if (set.attributes.empty()) return {};
    std::string text = fmt::format("\n{:<20} {:<10} {:>24}\n", "attribute", "type", "from ... to");
    for (const SetAttribute& each : set.attributes) {
        const std::string times = each.components > 1 ? fmt::format(" x {}", each.components) : "";
        text += fmt::format("{:<20} {:<10} {:>24}\n", printable(each.name, std::string::npos),
                            typeName(each.type) + times, fmt::format("{:.10g} ... {:.10g}", each.low, each.high));
    }
    return text;
}

Json levelsJson(const SetSummary& summary, const TileSet& set) {
    Json levels = Json::array();
    for (std::uint32_t level = 0; level < summary.levels.size(); ++level) {
        const SetLevelSummary& sum = summary.levels[level];
        levels.push_back({{"edge", edgeOf(set, level)},
                          {"tiles", sum.tiles},
                          {"original_tiles", sum.original_tiles},
                          {"splats", sum.splats},
                          {"stored", sum.stored},
                          {"bytes", sum.bytes},
                          {"error", sum.error},
                          {"spacing", sum.spacing},
                          {"radius_max", set.levels[level].radius_max * 2 * edgeOf(set, level)}});
    }
    return levels;
}

Json attributesJson(const TileSet& set) {
    Json attributes = Json::array();
    for (const SetAttribute& each : set.attributes)
        attributes.push_back({{"name", each.name},
                              {"type", typeName(each.type)},
                              {"components", each.components},
                              {"low", each.low},
                              {"high", each.high}});
    return attributes;
}

Json sensorsJson(const TileSet& set) {
    Json sensors = Json::array();
    for (const auto& sensor : set.sensors)
        sensors.push_back(sensor[3] == 0 ? Json() : Json{sensor[0], sensor[1], sensor[2]});
    return sensors;
}

} // namespace

SetSummary summarizeSet(const TileSet& set, const std::string& folder) {
    SetSummary summary;
    summary.levels.resize(set.levels.size());
    for (const SetTile& tile : set.tiles) {
        addTile(summary.levels[tile.level], tile);
        addTile(summary.all, tile);
        try {
            requireTile(set, tile, folder);
        } catch (const Error& error) {
            summary.damaged.emplace_back(error.what());
        }
    }
    for (std::uint32_t level = 0; level < set.levels.size(); ++level) {
        summary.levels[level].error = set.levels[level].error;
        summary.levels[level].spacing = medianSpacing(set, level);
    }
    return summary;
}

std::string setSummaryText(const std::string& folder, const SetSummary& summary, const TileSet& set) {
    std::string text =
        fmt::format("{}: tile set version {}\n\n", printable(folder, std::string::npos), kTileSetVersion);
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<16}{}\n", name, value);
    };
    const SetLevelSummary& all = summary.all;
    line("size", fmt::format("{}, {:.1f} bytes a splat", humanBytes(all.bytes), share(all.bytes, set.splats)));
    line("splats", fmt::format("{}, and {} merged; {:.1f} % of stored splats are copies of neighbours'", set.splats,
                               all.splats - set.splats, 100 * share(all.stored - all.splats, all.stored)));
    line("tiles", tilesText(summary));
    if (set.input_points > 0) line("input points", std::to_string(set.input_points));
    line("bounds",
         fmt::format("{} to {} input units", vectorText(set.bounds_min.data()), vectorText(set.bounds_max.data())));
    line("lattice",
         fmt::format("from {}, finest cores of {:.10g} input units", vectorText(set.lattice_origin.data()), set.edge));
    line("colour", set.colors ? "yes" : "no");
    line("oriented", set.oriented ? "yes" : "no");
    if (set.gaussians) line("Gaussians", "each in one original tile; merged ones in coarser tiles");
    line("up", upText(worldOf(set)));
    line("input unit", unitText(worldOf(set)));
    line("system", set.crs.empty() ? "not known" : printable(set.crs));
    line("noise", set.noise > 0 ? fmt::format("median {:.4g} input units", set.noise) : "none");
    if (!set.sensors.empty()) line("sensors", fmt::format("{} of {} scans", knownSensors(set), set.sensors.size()));
    return text + attributeTable(set) + levelTable(summary, set) + "\nsettings " +
           dumpJson(parseMetadata(set.settings), true) + "\n";
}

std::string setSummaryJson(const SetSummary& summary, const TileSet& set) {
    const SetLevelSummary& all = summary.all;
    Json json = {{"format", "tile set"},
                 {"version", kTileSetVersion},
                 {"file_bytes", all.bytes},
                 {"splats", set.splats},
                 {"merged_splats", all.splats - set.splats},
                 {"stored_splats", all.stored},
                 {"bytes_per_splat", share(all.bytes, set.splats)},
                 {"tiles", all.tiles},
                 {"original_tiles", all.original_tiles},
                 {"damaged_tiles", summary.damaged.size()},
                 {"input_points", set.input_points > 0 ? Json(set.input_points) : Json()},
                 {"lattice_origin", set.lattice_origin},
                 {"edge", set.edge},
                 {"bounds_min", set.bounds_min},
                 {"bounds_max", set.bounds_max},
                 {"has_color", set.colors},
                 {"oriented", set.oriented},
                 {"up", set.up},
                 {"metres_per_unit", set.metres},
                 {"crs", set.crs},
                 {"noise", set.noise},
                 {"sensors", sensorsJson(set)},
                 {"attributes", attributesJson(set)},
                 {"levels", levelsJson(summary, set)},
                 {"settings", parseMetadata(set.settings)}};
    if (set.gaussians) json["gaussians"] = true;
    return dumpJson(json, false) + "\n";
}

} // namespace pointrt

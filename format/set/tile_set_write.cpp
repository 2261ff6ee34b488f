// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/base/number_type.h"
#include "format/os/atomic_file.h"
#include "format/set/set_words.h"
#include "format/set/tile_set.h"

namespace pointrt {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// JSON on one line.
std::string text(const OrderedJson& json) { return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace); }

/// A line `"key": value,`; a list has a line for each element.
void addLine(std::string& out, const char* key, const OrderedJson& value) {
    out += std::string("  \"") + key + "\": " + text(value) + ",\n";
}

template <typename List, typename ToJson>
void addList(std::string& out, const char* key, const List& list, const ToJson& to_json, const char* end) {
    out += std::string("  \"") + key + "\": [";
    const char* separator = "\n";
    for (const auto& each : list) {
        out += separator + ("    " + text(to_json(each)));
        separator = ",\n";
    }
    out += (list.empty() ? "]" : "\n  ]") + std::string(end);
}

OrderedJson attributeJson(const SetAttribute& attribute) {
    return {{"name", attribute.name},
            {"type", typeName(attribute.type)},
            {"components", attribute.components},
            {"low", attribute.low},
            {"high", attribute.high}};
}

OrderedJson sensorJson(const std::array<double, 4>& sensor) {
    return sensor[3] == 0 ? OrderedJson() : OrderedJson::array({sensor[0], sensor[1], sensor[2]});
}

OrderedJson levelJson(const SetLevel& level) {
    return {{"tiles", level.tiles},
            {"splats", level.splats},
            {"error", level.error},
            {"radius_max", level.radius_max},
            {"radius_step", level.radius_step}};
}

OrderedJson tileJson(const SetTile& tile) {
    return {{"level", tile.level},   {"cell", tile.cell},       {"file", tile.file},
            {"splats", tile.splats}, {"stored", tile.stored},   {"bytes", tile.bytes},
            {"error", tile.error},   {"spacing", tile.spacing}, {"checksum", checksumWord(tile.checksum)}};
}

std::string jsonOf(const TileSet& set) {
    const bool knows_up = set.up != std::array<double, 3>{};
    std::string out = "{\n";
    addLine(out, "format", kSetFormat);
    addLine(out, "version", kTileSetVersion);
    addLine(out, "splats", set.splats);
    addLine(out, "input_points", set.input_points);
    addLine(out, "lattice", {{"origin", set.lattice_origin}, {"edge", set.edge}});
    addLine(out, "bounds", {{"min", set.bounds_min}, {"max", set.bounds_max}});
    addLine(out, "up", knows_up ? OrderedJson(set.up) : OrderedJson());
    addLine(out, "metres", set.metres != 0 ? OrderedJson(set.metres) : OrderedJson());
    addLine(out, "crs", set.crs);
    addLine(out, "colors", set.colors);
    addLine(out, "oriented", set.oriented);
    if (set.gaussians) addLine(out, "gaussians", true); // sets of discs do not have it, as before
    addLine(out, "noise", set.noise);
    // sorted by key, as in the reader
    addLine(out, "settings", nlohmann::json::parse(set.settings));
    addList(out, "attributes", set.attributes, attributeJson, ",\n");
    addList(out, "sensors", set.sensors, sensorJson, ",\n");
    addList(out, "levels", set.levels, levelJson, ",\n");
    addList(out, "tiles", set.tiles, tileJson, "\n");
    return out + "}\n";
}

} // namespace

void writeTileSet(const TileSet& set, const std::string& folder) {
    const std::string path = setFileOf(folder);
    if (const std::string fault = findTileSetFault(set); !fault.empty())
        throw Error(ExitCode::kCannotRun, path + ": would be invalid: " + fault);
    const std::string json = jsonOf(set);
    format::AtomicFile out;
    if (!out.open(path) || !out.write(json.data(), json.size()) || !out.commit())
        throw Error(ExitCode::kCannotWrite, path + ": " + out.error());
}

} // namespace pointrt

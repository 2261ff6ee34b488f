// SPDX-License-Identifier: Apache-2.0
// Reads set.json, which may be hostile: keeps only known keys, converts tiles one by one, and limits the JSON in
// memory.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "format/base/error.h"
#include "format/base/json_integer.h"
#include "format/base/number_type.h"
#include "format/base/printable.h"
#include "format/os/mapped_file.h"
#include "format/set/set_fault.h"
#include "format/set/set_words.h"
#include "format/set/tile_set.h"

namespace pointrt {

namespace {

/// Not ordered_json, whose time is quadratic in the number of keys of an object.
using Json = nlohmann::json;

constexpr int kDepthMax = 64; // of "settings", whose text is printed by a recursive function
/// Limits of the JSON in memory at any time: enough for a quarter of a million sensors. The parser scans a list at the
/// end of each object in it, so the product of both limits bounds its time to half a second.
constexpr std::size_t kValuesMax = std::size_t{1} << 20, kObjectsMax = 256;

constexpr std::string_view kKeys[] = {"format", "version",  "splats",  "input_points", "lattice",  "bounds",
                                      "up",     "metres",   "crs",     "colors",       "oriented", "noise",
                                      "levels", "settings", "sensors", "attributes",   "tiles",    "gaussians"};

const Json& memberOf(const Json& object, const char* key) {
    if (!object.is_object()) throw SetFault("is not an object");
    const auto found = object.find(key);
    if (found == object.end()) throw SetFault(std::string(key) + " is missing");
    return *found;
}

double numberOf(const Json& object, const char* key) {
    const Json& value = memberOf(object, key);
    if (!value.is_number()) throw SetFault(std::string(key) + " is not a number");
    return value.get<double>();
}

template <typename Whole>
Whole asWhole(const Json& value, const char* key) {
    const std::optional<Whole> number = optionalJsonInteger<Whole>(value);
    if (!number)
        throw SetFault(std::string(key) + " is not a whole number from " +
                       std::to_string(std::numeric_limits<Whole>::min()) + " to " +
                       std::to_string(std::numeric_limits<Whole>::max()));
    return *number;
}

template <typename Whole>
Whole wholeOf(const Json& object, const char* key) {
    return asWhole<Whole>(memberOf(object, key), key);
}

bool flagOf(const Json& object, const char* key) {
    const Json& value = memberOf(object, key);
    if (!value.is_boolean()) throw SetFault(std::string(key) + " is neither true nor false");
    return value.get<bool>();
}

std::string wordOf(const Json& object, const char* key) {
    const Json& value = memberOf(object, key);
    if (!value.is_string()) throw SetFault(std::string(key) + " is not a string");
    return value.get<std::string>();
}

const Json& listOf(const Json& object, const char* key) {
    const Json& value = memberOf(object, key);
    if (!value.is_array()) throw SetFault(std::string(key) + " is not a list");
    return value;
}

std::array<double, 3> asVector(const Json& value, const char* key) {
    const bool holds = value.is_array() && value.size() == 3 &&
                       std::all_of(value.begin(), value.end(), [](const Json& each) { return each.is_number(); });
    if (!holds) throw SetFault(std::string(key) + " is not a list of 3 numbers");
    return value.get<std::array<double, 3>>();
}

std::array<double, 3> vectorOf(const Json& object, const char* key) { return asVector(memberOf(object, key), key); }

TileCell cellOf(const Json& object) {
    const Json& value = memberOf(object, "cell");
    if (!value.is_array() || value.size() != 3) throw SetFault("cell is not a list of 3 numbers");
    TileCell cell;
    for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = asWhole<std::int32_t>(value[axis], "cell");
    return cell;
}

SetTile tileOf(const Json& json) {
    SetTile tile;
    tile.level = wholeOf<std::uint32_t>(json, "level");
    tile.cell = cellOf(json);
    tile.file = wordOf(json, "file");
    tile.splats = wholeOf<std::uint64_t>(json, "splats");
    tile.stored = wholeOf<std::uint64_t>(json, "stored");
    tile.bytes = wholeOf<std::uint64_t>(json, "bytes");
    tile.error = numberOf(json, "error");
    tile.spacing = numberOf(json, "spacing");
    const auto checksum = checksumOfWord(wordOf(json, "checksum"));
    if (!checksum) throw SetFault("checksum is not 16 hexadecimal digits");
    tile.checksum = *checksum;
    return tile;
}

SetLevel levelOf(const Json& json) {
    return {numberOf(json, "radius_max"), numberOf(json, "radius_step"), wholeOf<std::uint64_t>(json, "tiles"),
            wholeOf<std::uint64_t>(json, "splats"), numberOf(json, "error")};
}

SetAttribute attributeOf(const Json& json) {
    const std::string type = wordOf(json, "type");
    SetAttribute attribute{wordOf(json, "name"), PRO_TYPE_I8, wholeOf<std::uint32_t>(json, "components"),
                           numberOf(json, "low"), numberOf(json, "high")};
    while (attribute.type <= PRO_TYPE_F64 && type != typeName(attribute.type)) ++attribute.type;
    return attribute; // the check refuses unknown types
}

std::array<double, 4> sensorOf(const Json& json) {
    if (json.is_null()) return {};
    const std::array<double, 3> place = asVector(json, "place");
    return {place[0], place[1], place[2], 1};
}

/// Reads each element of a list; faults get its index.
template <typename Element, typename Read>
std::vector<Element> readList(const Json& json, const char* key, const Read& read) {
    std::vector<Element> list;
    for (const Json& each : listOf(json, key)) {
        try {
            list.push_back(read(each));
        } catch (const SetFault& fault) {
            throw SetFault(placeIn(key, list.size()) + fault.what());
        }
    }
    return list;
}

void requireVersion(const Json& version) {
    const auto number = optionalJsonInteger<std::uint64_t>(version);
    if (!number) throw SetFault("version is not a whole number");
    if (*number != kTileSetVersion)
        throw SetFault("version " + version.dump() + ", but only " + std::to_string(kTileSetVersion) +
                       " is supported: this program is too old, or the file is damaged");
}

/// A callback of the parser for each value. Converts tiles at once, so that at most one of them exists as JSON.
class TileTaker {
public:
    explicit TileTaker(std::vector<SetTile>& tiles) : tiles_(tiles) {}

    /// @return whether the parser keeps the value
    bool operator()(int depth, Json::parse_event_t event, Json& value) {
        if (depth > kDepthMax) throw SetFault("nests deeper than " + std::to_string(kDepthMax));
        if (depth == 0 && event != Json::parse_event_t::object_start && event != Json::parse_event_t::object_end)
            throw SetFault("is not a JSON object");
        if (depth == 1 && event == Json::parse_event_t::key) return enter(value.get_ref<const std::string&>());
        if (depth == 1 && event == Json::parse_event_t::value && key_ == "version") requireVersion(value);
        const bool is_tile = depth == kTileDepth && key_ == "tiles";
        if (is_tile && event == Json::parse_event_t::object_start) before_ = held_;
        count(event);
        if (!is_tile) return true;
        if (event == Json::parse_event_t::value || event == Json::parse_event_t::array_start)
            throw SetFault(placeIn("tiles", tiles_.size()) + "is not an object");
        if (event != Json::parse_event_t::object_end) return true;
        take(value);
        return false;
    }

private:
    bool enter(const std::string& key) {
        key_ = key;
        return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
    }

    void count(Json::parse_event_t event) {
        ++held_.values;
        if (event == Json::parse_event_t::object_start) ++held_.objects;
        if (held_.values > kValuesMax || held_.objects > kObjectsMax) throw SetFault("has too many values");
    }

    void take(const Json& value) {
        if (tiles_.size() == kTilesMax) throw SetFault("tiles: must have at most 2^20 entries");
        try {
            tiles_.push_back(tileOf(value));
        } catch (const SetFault& fault) {
            throw SetFault(placeIn("tiles", tiles_.size()) + fault.what());
        }
        held_ = before_;
    }

    static constexpr int kTileDepth = 2; ///< in the list within the object
    struct Held {
        std::size_t values = 0, objects = 0;
    };

    std::vector<SetTile>& tiles_;
    std::string key_;
    Held held_, before_; ///< JSON held now, and before the current tile
};

std::size_t lineOf(std::string_view text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
    return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

Json parse(std::string_view text, std::vector<SetTile>& tiles) {
    TileTaker taker(tiles);
    const auto callback = [&](int depth, Json::parse_event_t event, Json& value) { return taker(depth, event, value); };
    try {
        return Json::parse(text.begin(), text.end(), callback);
    } catch (const Json::parse_error& error) {
        throw SetFault("line " + std::to_string(lineOf(text, error.byte)) + " is not JSON");
    } catch (const Json::exception&) { // a number out of the range of doubles
        throw SetFault("has a number out of range");
    }
}

void readHead(const Json& json, TileSet& set) {
    if (wordOf(json, "format") != kSetFormat) throw SetFault(std::string("format is not \"") + kSetFormat + "\"");
    requireVersion(memberOf(json, "version"));
    set.splats = wholeOf<std::uint64_t>(json, "splats");
    set.input_points = wholeOf<std::uint64_t>(json, "input_points");
    const Json &lattice = memberOf(json, "lattice"), &bounds = memberOf(json, "bounds");
    set.lattice_origin = vectorOf(lattice, "origin");
    set.edge = numberOf(lattice, "edge");
    set.bounds_min = vectorOf(bounds, "min");
    set.bounds_max = vectorOf(bounds, "max");
    if (!memberOf(json, "up").is_null()) set.up = vectorOf(json, "up");
    if (!memberOf(json, "metres").is_null()) set.metres = numberOf(json, "metres");
    set.crs = wordOf(json, "crs");
    set.colors = flagOf(json, "colors");
    set.oriented = flagOf(json, "oriented");
    if (json.contains("gaussians")) set.gaussians = flagOf(json, "gaussians");
    set.noise = numberOf(json, "noise");
    set.settings = memberOf(json, "settings").dump();
}

TileSet readText(std::string_view text) {
    TileSet set;
    const Json json = parse(text, set.tiles);
    readHead(json, set);
    set.attributes = readList<SetAttribute>(json, "attributes", attributeOf);
    set.sensors = readList<std::array<double, 4>>(json, "sensors", sensorOf);
    set.levels = readList<SetLevel>(json, "levels", levelOf);
    listOf(json, "tiles"); // its elements are already converted
    if (const std::string fault = findTileSetFault(set); !fault.empty()) throw SetFault(fault);
    return set;
}

} // namespace

TileSet parseTileSet(std::string_view json, const std::string& path) {
    try {
        return readText(json);
    } catch (const SetFault& fault) {
        throw Error(ExitCode::kBadInput, path + ": " + fault.what());
    }
}

TileSet readTileSet(const std::string& folder) {
    const std::string path = setFileOf(folder);
    const auto refuse = [&](const std::string& reason) { throw Error(ExitCode::kBadInput, path + ": " + reason); };
    format::MappedFile file;
    if (!file.map(path.c_str())) refuse(file.error());
    if (file.bytes().size() > kTileSetBytesMax)
        refuse("has " + std::to_string(file.bytes().size()) + " bytes, more than the limit for sets");
    return parseTileSet({reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()}, path);
}

} // namespace pointrt

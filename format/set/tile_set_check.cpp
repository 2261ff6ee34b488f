// SPDX-License-Identifier: Apache-2.0
// Validates a set: the rules of SPEC.md for set.json beyond types.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "format/base/printable.h"
#include "format/set/set_fault.h"
#include "format/set/tile_set.h"
#include "pointrt/pro_layout.h"

namespace pointrt {

namespace {

// as in a file's header
constexpr double kLengthMin = 1e-30, kLengthMax = 1e30;
constexpr double kUpTolerance = 1e-5;
/// A quarter of the edge of a core, in cube units.
constexpr double kRadiusMax = 0.125;
/// Position steps of a tile along an edge of its core.
constexpr double kStepsOfCore = 1 << (PRO_POSITION_BITS - 1);
/// The largest integer that doubles, and so most JSON readers, hold exactly.
constexpr std::uint64_t kWholeMax = std::uint64_t{1} << 53;
constexpr std::size_t kFileNameMax = 255; // limit of most file systems

[[noreturn]] void refuse(const std::string& reason) { throw SetFault(reason); }

void require(bool holds, const char* reason) {
    if (!holds) refuse(reason);
}

bool allFinite(const std::array<double, 3>& vector) {
    return std::all_of(vector.begin(), vector.end(), [](double value) { return std::isfinite(value); });
}

bool isLength(double value) { return value >= kLengthMin && value <= kLengthMax; }
bool isNotNegative(double value) { return value >= 0 && value <= kLengthMax; }
bool isFloat(double value) { return static_cast<double>(static_cast<float>(value)) == value; }

void checkLattice(const TileSet& set) {
    for (const double value : set.lattice_origin)
        require(std::abs(value) <= kLengthMax, "lattice: origin is not finite or beyond 1e30");
    require(isLength(set.edge), "lattice: edge is not from 1e-30 to 1e30");
    require(!set.levels.empty() && set.levels.size() <= kTileSetLevelsMax, "levels: must have 1 to 32 entries");
    const auto top = static_cast<std::uint32_t>(set.levels.size() - 1);
    require(isLength(2 * edgeOf(set, top)), "lattice: edge is too large for so many levels");
}

void checkWorld(const TileSet& set) {
    const auto& up = set.up;
    require(allFinite(up), "up: is not finite");
    const double length = std::hypot(up[0], up[1], up[2]);
    require(length == 0 || std::abs(length - 1) <= kUpTolerance, "up: is not of unit length");
    require(set.metres == 0 || isLength(set.metres), "metres: is out of range");
    require(isNotNegative(set.noise), "noise: is out of range");
    require(set.input_points <= kWholeMax, "input_points: is above 2^53");
    for (std::size_t i = 0; i < set.sensors.size(); ++i) {
        const auto& sensor = set.sensors[i];
        const bool finite = allFinite({sensor[0], sensor[1], sensor[2]});
        const bool none = sensor == std::array<double, 4>{};
        if (!finite || (sensor[3] != 1 && !none))
            refuse(placeIn("sensors", i) + "is neither a finite position nor all zeros");
    }
}

void checkSettings(const TileSet& set) {
    const auto settings = nlohmann::json::parse(set.settings, nullptr, false);
    require(settings.is_object(), "settings: must be a JSON object");
}

void checkLevel(const SetLevel& level, const char* place) {
    requireOf(level.radius_max >= double{PRO_RADIUS_MIN} && level.radius_max <= kRadiusMax && isFloat(level.radius_max),
              place, "radius_max must be a float from 2^-60 to 0.125");
    requireOf(level.radius_step >= 0 && level.radius_step <= 1 && isFloat(level.radius_step), place,
              "radius_step must be a float from 0 to 1");
}

void checkAttribute(const SetAttribute& attribute, const char* place) {
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    const std::string& name = attribute.name;
    requireOf(!name.empty() && name.size() <= PRO_ATTRIBUTE_NAME_MAX && std::none_of(name.begin(), name.end(), control),
              place, "its name is empty, too long or has control characters");
    requireOf(attribute.type >= PRO_TYPE_I8 && attribute.type <= PRO_TYPE_F64, place, "has an unknown type");
    requireOf(attribute.components >= 1 && attribute.components <= PRO_ATTRIBUTE_COMPONENTS_MAX, place,
              "components is not from 1 to 4");
    requireOf(std::isfinite(attribute.low) && std::isfinite(attribute.high) && attribute.low <= attribute.high, place,
              "low and high are not finite or out of order");
}

void checkAttributes(const TileSet& set) {
    require(set.attributes.size() <= PRO_ATTRIBUTE_MAX, "attributes: must have at most 32 entries");
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < set.attributes.size(); ++i) {
        checkAttribute(set.attributes[i], placeIn("attributes", i).c_str());
        names.push_back(set.attributes[i].name);
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) refuse("attributes: " + printable(*twice) + " appears twice");
}

/// A name that cannot leave tiles/.
bool isTileFile(std::string_view file) {
    constexpr std::string_view kFolder = "tiles/", kSuffix = ".pro";
    if (!file.starts_with(kFolder) || !file.ends_with(kSuffix)) return false;
    file.remove_prefix(kFolder.size());
    const auto plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_' ||
               c == '.';
    };
    return file.size() > kSuffix.size() && file.size() <= kFileNameMax && file.front() != '.' &&
           std::all_of(file.begin(), file.end(), plain);
}

void checkTile(const TileSet& set, const SetTile& tile) {
    constexpr std::uint64_t kSplatsMax = std::numeric_limits<std::uint32_t>::max();
    require(tile.level < set.levels.size(), "level does not exist");
    require(isTileFile(tile.file), "file must be a plain name in tiles/ that ends in .pro");
    require(tile.splats >= 1 && tile.splats <= tile.stored, "splats are not from 1 to the number stored");
    require(tile.stored <= kSplatsMax, "stored are more than 2^32 - 1");
    require(tile.bytes >= PRO_HEADER_BYTES && tile.bytes <= kWholeMax, "bytes are not those of a .pro file");
    require(isNotNegative(tile.error), "error is out of range");
    require(isNotNegative(tile.spacing), "spacing is out of range");
}

void checkOrder(const TileSet& set, std::size_t i) {
    const SetTile &before = set.tiles[i - 1], &tile = set.tiles[i];
    if (isTileBefore(before, tile)) return;
    require(isTileBefore(tile, before), "appears twice");
    refuse("does not follow the one before: highest level first, then in Morton order");
}

/// Constraints between a tile and its parent.
void checkParent(const TileSet& set, const SetTile& tile, std::vector<bool>& has_children) {
    const auto parent = findTile(set, tile.level + 1, parentOf(tile.cell));
    require(parent.has_value(), "its parent does not exist");
    require(tile.error <= set.tiles[*parent].error, "error is larger than its parent's");
    has_children[*parent] = true;
}

/// Calls check(index) for each tile; faults get its index and cell.
template <typename Check>
void forEachTile(const TileSet& set, const Check& check) {
    for (std::size_t i = 0; i < set.tiles.size(); ++i) {
        try {
            check(i);
        } catch (const SetFault& fault) {
            const SetTile& tile = set.tiles[i];
            std::string place = "tiles[" + std::to_string(i) + "] " + std::to_string(tile.level);
            for (const std::int32_t axis : tile.cell) place += "-" + std::to_string(axis);
            refuse(place + ": " + fault.what());
        }
    }
}

void checkTree(const TileSet& set) {
    const auto top = static_cast<std::uint32_t>(set.levels.size() - 1);
    std::vector<bool> has_children(set.tiles.size());
    forEachTile(set, [&](std::size_t i) {
        const SetTile& tile = set.tiles[i];
        if (i == 0) return require(tile.level == top, "is not of the highest level");
        require(tile.level < top, "is a second tile of the highest level");
        checkParent(set, tile, has_children);
    });
    forEachTile(set, [&](std::size_t i) {
        const bool original = set.tiles[i].isOriginal();
        require(!original || !has_children[i], "has children, but its error is 0");
        require(original || has_children[i], "has no children, but its error is not 0");
    });
}

void checkFiles(const TileSet& set) {
    std::vector<std::string_view> files;
    files.reserve(set.tiles.size());
    for (const SetTile& tile : set.tiles) files.push_back(tile.file);
    std::sort(files.begin(), files.end());
    const auto twice = std::adjacent_find(files.begin(), files.end());
    if (twice != files.end()) refuse("tiles: " + std::string(*twice) + " is the file of two tiles");
}

void checkSums(const TileSet& set) {
    std::vector<SetLevel> sums(set.levels.size());
    std::uint64_t splats = 0; // at most 2^20 tiles of less than 2^32 splats: no overflow
    for (const SetTile& tile : set.tiles) {
        SetLevel& sum = sums[tile.level];
        ++sum.tiles;
        sum.splats += tile.splats;
        sum.error = std::max(sum.error, tile.error);
        if (tile.isOriginal()) splats += tile.splats;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::string place = placeIn("levels", i);
        requireOf(sums[i].tiles > 0, place.c_str(), "has no tiles");
        requireOf(sums[i].tiles == set.levels[i].tiles, place.c_str(),
                  "tiles is not the number of tiles of this level");
        requireOf(sums[i].splats == set.levels[i].splats, place.c_str(), "splats are not the sum of its tiles'");
        requireOf(sums[i].error == set.levels[i].error, place.c_str(), "error is not the largest of its tiles'");
    }
    require(splats == set.splats, "splats: are not the sum of the tiles without children");
}

void checkBounds(const TileSet& set) {
    const TileBox core = coreOf(set, set.tiles.front());
    const double step = edgeOf(set, set.tiles.front().level) / kStepsOfCore;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = set.bounds_min[axis], high = set.bounds_max[axis];
        require(std::isfinite(low) && std::isfinite(high) && low <= high, "bounds: are not finite or out of order");
        require(low >= core.low[axis] - step && high <= core.high[axis] + step,
                "bounds: are not inside the tile of the highest level");
    }
}

void check(const TileSet& set) {
    checkLattice(set);
    checkWorld(set);
    checkSettings(set);
    for (std::size_t i = 0; i < set.levels.size(); ++i) checkLevel(set.levels[i], placeIn("levels", i).c_str());
    checkAttributes(set);
    require(!set.tiles.empty() && set.tiles.size() <= kTilesMax, "tiles: must have 1 to 2^20 entries");
    forEachTile(set, [&](std::size_t i) { checkTile(set, set.tiles[i]); });
    forEachTile(set, [&](std::size_t i) {
        if (i > 0) checkOrder(set, i);
    });
    checkTree(set);
    checkFiles(set);
    checkSums(set);
    checkBounds(set);
}

} // namespace

std::string findTileSetFault(const TileSet& set) {
    try {
        check(set);
        return {};
    } catch (const SetFault& fault) {
        return fault.what();
    }
}

} // namespace pointrt

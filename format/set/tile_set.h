// SPDX-License-Identifier: Apache-2.0
// A scan in tiles: the folder NAME.proset with set.json and tiles/*.pro (format/SPEC.md, Sets). What set.json says, and
// where tiles lie.
//
// Space is an octree of cubes. Level L's tiles stand on a grid of cubes of edge_L = edge * 2^L anchored at
// lattice_origin. A tile's *core* is its cube, half open; its file's cube is twice as large around the same centre.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

constexpr unsigned kTileSetVersion = 1;

/// What a set can have. Larger ones are refused before they are held in memory.
constexpr std::size_t kTileSetLevelsMax = 32;
constexpr std::size_t kTilesMax = std::size_t{1} << 20; ///< a million splats each: 10^12
/// Of set.json, 256 a tile.
constexpr std::size_t kTileSetBytesMax = 256 * kTilesMax;

using TileCell = std::array<std::int32_t, 3>;

struct SetTile {
    std::uint32_t level = 0;    ///< 0 is the finest
    TileCell cell{};            ///< of its level's grid, from lattice_origin
    std::string file;           ///< below the set's folder: "tiles/L-X-Y-Z.pro"
    std::uint64_t splats = 0;   ///< whose centres lie in the core, 1 to 2^32 - 1
    std::uint64_t stored = 0;   ///< with those repeated from neighbours: the file's splat_count
    std::uint64_t bytes = 0;    ///< of the file
    double error = 0;           ///< input units, how far the surface may be from the original splats'; 0: original ones
    double spacing = 0;         ///< input units, median distance between neighbouring splats; 0: not known
    std::uint64_t checksum = 0; ///< the file's header_xxh3, which covers the sums of all its sections

    bool isOriginal() const { return error == 0; }
};

/// What all tiles of a level have alike, and their sums.
struct SetLevel {
    double radius_max = 0;  ///< cube units, up to 1/8, which is a quarter of a core's edge; a float, as in the headers
    double radius_step = 0; ///< octaves a radius code; a float, as in the headers
    std::uint64_t tiles = 0, splats = 0;
    double error = 0; ///< of its tiles the largest
};

struct SetAttribute {
    std::string name;                       ///< as in ATTD
    std::uint32_t type = 0, components = 0; ///< PRO_TYPE_*, 1 to 4
    double low = 0, high = 0;               ///< of all finite values of the original splats; 0 where there are none
};

struct TileSet {
    std::array<double, 3> lattice_origin{}; ///< input coordinates of cell (0, 0, 0)'s lowest corner, on every level
    double edge = 0;                        ///< of level 0's cores, input units
    std::array<double, 3> up{};             ///< unit length; zeros: not known
    double metres = 0;                      ///< to an input unit; 0: not known
    std::string crs;                        ///< of the input; "": not known
    std::array<double, 3> bounds_min{}, bounds_max{}; ///< of the original splats' centres, input coordinates
    std::uint64_t input_points = 0;                   ///< 0: not known
    std::uint64_t splats = 0;                         ///< original ones
    bool colors = false, oriented = false;            ///< as the headers' flags
    double noise = 0;                                 ///< median over the original splats, input units
    std::vector<SetLevel> levels;                     ///< [0] finest, at least one
    std::vector<SetAttribute> attributes;             ///< those of every tile, in their order
    std::vector<std::array<double, 4>> sensors;       ///< as SENS
    std::string settings = "{}";                      ///< JSON object of the bake's options, for people
    std::vector<SetTile> tiles;                       ///< as isTileBefore has them: the root is the first one
};

/// Half open: a point is in it where low <= point < high on every axis.
struct TileBox {
    std::array<double, 3> low{}, high{};
};

/// A .pro file's cube.
struct TileCube {
    std::array<double, 3> origin{};
    double scale = 0;
};

/// Of a level's cores, input units: edge * 2^level, exactly.
double edgeOf(const TileSet& set, std::uint32_t level);
/// Neighbours of a level have their common corners to the bit.
TileBox coreOf(const TileSet& set, std::uint32_t level, const TileCell& cell);
TileBox coreOf(const TileSet& set, const SetTile& tile);
/// The cube of the tile's file, to the bit: scale is two edges, origin half an edge below the core's lowest corner.
TileCube cubeOf(const TileSet& set, const SetTile& tile);

/// One level up.
TileCell parentOf(const TileCell& cell);
/// "tiles/L-X-Y-Z.pro".
std::string tileFileName(std::uint32_t level, const TileCell& cell);

/// The order of TileSet::tiles: highest level first, then Morton order of cells (z before y before x, negative ones
/// first). So the children of a tile stand together, and those of tiles in their parents' order.
bool isTileBefore(const SetTile& a, const SetTile& b);
/// The number of a tile in tiles that stand in order; nothing where it does not exist.
std::optional<std::uint32_t> findTile(const TileSet& set, std::uint32_t level, const TileCell& cell);
/// Numbers of tiles, for each tile, of a set that was read or arranged.
std::vector<std::vector<std::uint32_t>> childrenOf(const TileSet& set);
/// Puts tiles in order, and fills in what follows from them: the levels' tiles, splats and error, and the set's splats.
/// Every tile's level must be below levels.size().
void arrangeTiles(TileSet& set);

/// Why no reader takes this set: "tiles[3]: reason"; "" for a good one.
std::string findTileSetFault(const TileSet& set);

/// Whether path is a folder with a set.json in it, or a name that ends in .proset.
bool isTileSet(const std::string& path);
/// "NAME.proset/set.json".
std::string setFileOf(const std::string& folder);

/// Reads set.json; looks at no tile. Of hostile ones memory is bounded by a few times kTileSetBytesMax.
/// Throws Error{kBadInput, "NAME.proset/set.json: reason"}.
TileSet readTileSet(const std::string& folder);
/// The same of set.json's bytes. @param path for messages
TileSet parseTileSet(std::string_view json, const std::string& path);

/// Writes set.json into a folder that is there; it appears whole, in place of the one before. The same content gives
/// the same bytes. Throws Error: kCannotWrite; kCannotRun for a set that no reader would take.
void writeTileSet(const TileSet& set, const std::string& folder);

} // namespace pointrt

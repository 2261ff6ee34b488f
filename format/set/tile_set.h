// SPDX-License-Identifier: Apache-2.0
// Tile sets: a folder NAME.proset with set.json and tiles/*.pro (format/SPEC.md, Sets). The content of set.json, and
// the geometry of tiles.
//
// Tiles form an octree. Those of level L lie on a grid of cubes of edge_L = edge * 2^L with its origin at
// lattice_origin. A tile's *core* is its half-open cube; the cube of its file has the same centre and twice the edge.
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

/// Limits of sets. Larger ones are refused before they take memory.
constexpr std::size_t kTileSetLevelsMax = 32;
constexpr std::size_t kTilesMax = std::size_t{1} << 20; ///< a million splats each: 10^12
/// Size of set.json: 256 bytes per tile.
constexpr std::size_t kTileSetBytesMax = 256 * kTilesMax;

using TileCell = std::array<std::int32_t, 3>;

struct SetTile {
    std::uint32_t level = 0;    ///< 0 is the finest
    TileCell cell{};            ///< in the grid of its level, from lattice_origin
    std::string file;           ///< relative to the folder of the set: "tiles/L-X-Y-Z.pro"
    std::uint64_t splats = 0;   ///< with centres in the core, 1 to 2^32 - 1
    std::uint64_t stored = 0;   ///< including copies from neighbours: splat_count of the file
    std::uint64_t bytes = 0;    ///< of the file
    double error = 0;           ///< input units, largest distance from the original surface; 0: original splats
    double spacing = 0;         ///< input units, median distance between neighbouring splats; 0: unknown
    std::uint64_t checksum = 0; ///< header_xxh3 of the file, which covers the checksums of all sections

    bool isOriginal() const { return error == 0; }
};

/// Common values and sums of the tiles of a level.
struct SetLevel {
    double radius_max = 0;  ///< cube units, up to 1/8, a quarter of the edge of a core; a float, as in headers
    double radius_step = 0; ///< octaves per radius code; a float, as in headers
    std::uint64_t tiles = 0, splats = 0;
    double error = 0; ///< largest of its tiles
};

struct SetAttribute {
    std::string name;                       ///< as in ATTD
    std::uint32_t type = 0, components = 0; ///< PRO_TYPE_*, 1 to 4
    double low = 0, high = 0; ///< range of all finite values of the original splats; 0 if no value is finite
};

struct TileSet {
    std::array<double, 3> lattice_origin{}; ///< lowest corner of cell (0, 0, 0) of every level, input coordinates
    double edge = 0;                        ///< of the cores of level 0, input units
    std::array<double, 3> up{};             ///< unit length; 0 if unknown
    double metres = 0;                      ///< per input unit; 0 if unknown
    std::string crs;                        ///< of the input; "" if unknown
    std::array<double, 3> bounds_min{}, bounds_max{}; ///< of the centres of original splats, input coordinates
    std::uint64_t input_points = 0;                   ///< 0 if unknown
    std::uint64_t splats = 0;                         ///< original splats
    bool colors = false, oriented = false;            ///< as the flags in headers
    bool gaussians = false;                           ///< all tiles hold Gaussians, each in one original tile
    double noise = 0;                                 ///< median of the original splats, input units
    std::vector<SetLevel> levels;                     ///< finest first, at least one
    std::vector<SetAttribute> attributes;             ///< of every tile, in this order
    std::vector<std::array<double, 4>> sensors;       ///< as SENS
    std::string settings = "{}";                      ///< JSON object with the options of the bake, for people
    std::vector<SetTile> tiles;                       ///< ordered by isTileBefore: the root comes first
};

/// A half-open box: it contains points with low <= point < high on every axis.
struct TileBox {
    std::array<double, 3> low{}, high{};
};

/// The cube of a .pro file.
struct TileCube {
    std::array<double, 3> origin{};
    double scale = 0;
};

/// The edge of the cores of a level, input units: edge * 2^level, exactly.
double edgeOf(const TileSet& set, std::uint32_t level);
/// The core of a cell, in input coordinates. Neighbours of a level share corners to the bit.
TileBox coreOf(const TileSet& set, std::uint32_t level, const TileCell& cell);
TileBox coreOf(const TileSet& set, const SetTile& tile);
/// The cube of the tile's file, to the bit: scale is two edges of the core, origin half an edge below its lowest
/// corner.
TileCube cubeOf(const TileSet& set, const SetTile& tile);

/// The cell that contains this one, one level up.
TileCell parentOf(const TileCell& cell);
/// "tiles/L-X-Y-Z.pro".
std::string tileFileName(std::uint32_t level, const TileCell& cell);

/// The order of TileSet::tiles: highest level first, then Morton order of cells (z before y before x, negative first).
/// The children of a tile are adjacent, in the order of their parents.
bool isTileBefore(const SetTile& a, const SetTile& b);
/// The index of a tile in ordered tiles, or none.
std::optional<std::uint32_t> findTile(const TileSet& set, std::uint32_t level, const TileCell& cell);
/// Indices of the children of each tile, for a valid set.
std::vector<std::vector<std::uint32_t>> childrenOf(const TileSet& set);
/// Sorts tiles, and computes tiles, splats and error of each level and splats of the set. Levels of tiles must be below
/// levels.size().
void arrangeTiles(TileSet& set);

/// Why the set is invalid: "tiles[3]: reason"; "" if it is valid.
std::string findTileSetFault(const TileSet& set);

/// Whether path is a folder that contains set.json, or ends in .proset.
bool isTileSet(const std::string& path);
/// "NAME.proset/set.json".
std::string setFileOf(const std::string& folder);

/// Reads set.json, but no tile. Hostile files take at most a few times kTileSetBytesMax of memory. Throws
/// Error{kBadInput, "NAME.proset/set.json: reason"}.
TileSet readTileSet(const std::string& folder);
/// Parses the bytes of set.json.
/// @param path for messages
TileSet parseTileSet(std::string_view json, const std::string& path);

/// Writes set.json into an existing folder, replacing an existing one atomically. Equal content gives equal bytes.
/// Throws Error: kCannotWrite; kCannotRun for an invalid set.
void writeTileSet(const TileSet& set, const std::string& folder);

} // namespace pointrt

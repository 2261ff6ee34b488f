// SPDX-License-Identifier: GPL-3.0-or-later
// What is decided once for a whole set, before any of its tiles is made: where space is cut, what points have, which
// way is up and out. Every step of a bake reads it, and none of them changes it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/octree/octree.h"
#include "preprocess/surface/decisions.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt {

/// Half-open, input coordinates: low <= position < high.
using PlanBox = Eigen::AlignedBox3d;

/// A tile of original points: a cube of edge plan.edge * 2^level, at that many edges from plan.lattice_origin.
struct PlanTile {
    std::uint32_t level = 0;
    std::array<std::int32_t, 3> cell{}; ///< none below 0
    std::uint64_t points = 0;           ///< in its core, at least 1
    double spacing = 0;                 ///< input units: roughly how far apart they lie, if they lie on a surface
};

struct PlanAttribute {
    std::string name;
    Scalar type = Scalar::kF32; ///< in buckets and tiles
    std::uint32_t components = 1;
    Scalar read_type = Scalar::kF32; ///< that readers need, which holds the values of all files

    std::size_t bytesEach() const { return scalarSize(type) * components; }
};

/// What buckets hold of each point beside its position.
struct PlanSchema {
    bool normals = false, normal_sides = true; ///< as Cloud::normal_sides
    bool colors = false, radii = false;
    std::size_t scan_bytes = 0; ///< of a scan's number: 0 (there is one scan), 1, 2 or 4
    /// In the order of the files; kScanNumber, where it is wanted, is the last one and stands in no record: it is the
    /// scan's number.
    std::vector<PlanAttribute> attributes;
    bool scan_attribute = false; ///< whether it is
};

/// A scan of all files, in the order read.
struct PlanScan {
    std::string name;
    std::optional<Vec3d> sensor; ///< input coordinates
    std::uint64_t points = 0;    ///< that stay
    float largest_color = 0;     ///< of colours whose scale the whole scan tells; 0: all are black
};

struct PlanInput {
    std::string path, format;
    std::uint64_t bytes = 0;
    std::int64_t modified_ns = 0; ///< since 1970
    std::uint64_t points = 0, kept = 0, scans = 0;
    double seconds = 0; ///< of the first reading
};

/// A thinned sample of all points with the normals that they are to have: what tells the sides of tiles that nothing
/// else tells. Empty where given normals, sensors or up do.
struct PlanSides {
    std::vector<Vec3d> positions; ///< input coordinates
    std::vector<Vec3f> normals;   ///< unit length, pointing out
};

/// Options of the bake of tiles. Not in the plan's file: whoever reads one gives the same command line again, whose
/// `settings` are held against the file's.
struct SetBakeOptions {
    SurfaceOptions surface;
    OctreeOptions octree;
    bool prune = true;
    PruneOptions pruning;
    bool index = true;
    float reflectivity = 0;
    std::uint64_t max_memory = std::uint64_t{4} << 30; ///< bytes that the whole process is to stay below
    /// Take away what is needed no more: buckets once all blocks are baked, splats once all tiles that they reach into
    /// are made. Of many processes none knows what the others still read.
    bool drop_work = false;
};

/// Some of a plan's blocks.
struct BlockRange {
    std::uint32_t first = 0, end = 0;
};

struct SetPlan {
    std::string output; ///< the set's folder, NAME.proset
    std::string work;   ///< its steps' files lie below: NAME.proset.work

    Vec3d lattice_origin = Vec3d::Zero(); ///< the corner of all tiles' grids; every coordinate of a core is exact
    double edge = 1;                      ///< of the cores of level 0, a power of two
    std::uint32_t levels = 1;             ///< the root is cell 0 0 0 of level levels - 1, and holds all points
    std::vector<PlanTile> tiles;          ///< that partition the points, along a Morton curve
    std::vector<std::uint32_t> first_tile_of_block; ///< [blocks + 1]

    PlanBox bounds; ///< of the points that stay
    std::uint64_t points = 0;
    std::uint64_t points_read = 0, points_non_finite = 0, points_filtered = 0;
    std::uint64_t points_stray = 0; ///< left out: so far away that no tile is made of them

    PlanSchema schema;
    std::vector<PlanScan> scans;
    std::vector<PlanInput> inputs;
    WorldFrame world;               ///< up as told by the command line, a file or the sample
    std::string up_from, up_reason; ///< as BakeReport has them
    std::string source_header;
    std::vector<Note> notes;

    /// For the points of tiles: bake.surface.orient is to be this one. Sides of normals that it leaves open are those
    /// of `sides`, where there are any.
    OrientMode orient = OrientMode::kAuto;
    PlanSides sides;
    /// Measured once points are split, which makes writeTraits' file; noise is empty where they are too few, or not to
    /// be cleaned.
    CloudTraits traits;

    std::string settings; ///< JSON of all options that the bytes depend on
    SetBakeOptions bake;

    std::uint32_t blocks() const { return static_cast<std::uint32_t>(first_tile_of_block.size()) - 1; }
};

/// Edge of the cores of a level, input units.
double edgeOf(const SetPlan& plan, std::uint32_t level);

/// Points whose splats can be estimated at once: that takes some 250 bytes of each, and the program 256 MiB.
/// @param max_memory bytes that the whole process is to stay below
std::uint64_t mostPointsAtOnce(std::uint64_t max_memory);

/// A tile's core.
PlanBox coreOf(const SetPlan& plan, const PlanTile& tile);

/// Width of a tile's halo to begin with, input units: wide enough for what lies evenly, and no more points than those
/// of three tiles, on a surface.
double firstHalo(const SetPlan& plan, const PlanTile& tile);

/// "L-X-Y-Z", which files of the tile are called.
std::string nameOf(const PlanTile& tile);

/// Numbers in plan.tiles of the tiles of some blocks.
struct TileRange {
    std::uint32_t first = 0, end = 0;
};
TileRange tilesOf(const SetPlan& plan, BlockRange blocks);

/// Numbers in plan.tiles of the tiles whose cores a box reaches into, ascending.
std::vector<std::uint32_t> tilesIn(const SetPlan& plan, const PlanBox& box);

/// The folders and files of a bake, below its work folder.
std::string planFile(const std::string& work); ///< plan.json
std::string bucketsFolder(const SetPlan& plan);
std::string bucketFile(const SetPlan& plan, const PlanTile& tile); ///< buckets/L-X-Y-Z.points
std::string splitMark(const SetPlan& plan);                        ///< there once all buckets are whole
/// There once the step is done to its end, by a process that then drops what it was made from.
std::string blocksMark(const SetPlan& plan);
std::string levelsMark(const SetPlan& plan);
std::string splatsFolder(const SetPlan& plan); ///< splats, of splat files
/// set: the set while it is made, with its folder tiles. Once set.json stands in it, it is renamed to plan.output.
std::string finishedFolder(const std::string& work);

/// Writes plan.json, whole or not at all. Same plan, same bytes. Throws Error (kCannotWrite).
void writePlan(const SetPlan& plan);

/// Makes a file of no more than its name. Throws Error (kCannotWrite).
void writeMark(const std::string& path);

/// With those above it, where they are missing. Throws Error (kCannotWrite).
void makeFolder(const std::string& path);

/// Removes a file, or a folder with all that it holds, where there is one. Throws Error (kCannotWrite).
void takeAway(const std::string& path);

/// Takes down how wide discs may be, once all are known: infinity, where nothing limits them. Throws Error
/// (kCannotWrite).
void writeWidestRadius(const SetPlan& plan, float radius);
/// Nothing before that. Throws Error (kBadInput).
std::optional<float> readWidestRadius(const SetPlan& plan);

/// Takes down what holds for all of the plan's points beside it. Throws Error (kCannotWrite).
void writeTraits(const SetPlan& plan, const CloudTraits& traits);

/// Reads work + "/plan.json", but for `bake`. Throws Error (kBadInput) where it is missing or not as it should be.
SetPlan readPlan(const std::string& work);

} // namespace pointrt

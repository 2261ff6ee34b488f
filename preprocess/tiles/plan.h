// SPDX-License-Identifier: GPL-3.0-or-later
// Decisions for a whole set, made before any of its tiles: the tiles, the schema of points, up and orientation. Every
// step of a bake reads the plan, and none changes it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/no_data.h"
#include "preprocess/octree/octree.h"
#include "preprocess/surface/decisions.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt {

/// Half-open, input coordinates: low <= position < high.
using PlanBox = Eigen::AlignedBox3d;

/// A tile of original points: a cube of edge plan.edge * 2^level; cell counts such edges from plan.lattice_origin.
struct PlanTile {
    std::uint32_t level = 0;
    std::array<std::int32_t, 3> cell{}; ///< not negative
    std::uint64_t points = 0;           ///< in its core, at least 1
    double spacing = 0;                 ///< input units: approximate spacing, assuming a surface
};

struct PlanAttribute {
    std::string name;
    Scalar type = Scalar::kF32; ///< in buckets and tiles
    std::uint32_t components = 1;
    Scalar read_type = Scalar::kF32; ///< type used while reading, which holds the values of all files

    std::size_t bytesEach() const { return scalarSize(type) * components; }
};

/// Values of each point in buckets, beside the position.
struct PlanSchema {
    bool normals = false, normal_sides = true; ///< normal_sides: as Cloud::normal_sides
    bool colors = false, radii = false;
    bool noise = false;         ///< as Cloud::noise
    bool silhouettes = false;   ///< see flagSilhouettes
    std::size_t scan_bytes = 0; ///< size of a scan number: 0 (there is one scan), 1, 2 or 4
    /// In the order of the files. kScanNumber, if selected, is the last one and not stored in records: it is the scan
    /// number.
    std::vector<PlanAttribute> attributes;
    bool scan_attribute = false; ///< kScanNumber is selected
};

/// A scan of all files, in the order read.
struct PlanScan {
    std::string name;
    std::optional<Vec3d> sensor; ///< input coordinates
    std::uint64_t points = 0;    ///< kept points
    float largest_color = 0;     ///< BatchFindings::largest_color; 0 for 16-bit colours: all are black
    std::vector<NoData> no_data; ///< points that every pass leaves out
};

struct PlanInput {
    std::string path, format;
    std::uint64_t bytes = 0;
    std::int64_t modified_ns = 0; ///< since 1970
    std::uint64_t points = 0, kept = 0, scans = 0;
    double seconds = 0; ///< time of the first pass
};

/// A thinned sample of all points with oriented normals. It orients tiles whose orientation nothing else decides; empty
/// if given normals, sensors or up decide.
struct PlanSides {
    std::vector<Vec3d> positions; ///< input coordinates
    std::vector<Vec3f> normals;   ///< unit length, pointing out
};

/// Options for baking tiles. Not in the plan's file: each step gets the same command line, whose `settings` are
/// compared with the file's.
struct SetBakeOptions {
    SurfaceOptions surface;
    OctreeOptions octree;
    bool prune = true;
    PruneOptions pruning;
    bool index = true;
    float reflectivity = 0;
    std::uint64_t max_memory = std::uint64_t{4} << 30; ///< memory limit of the process in bytes
    /// Remove files that are no longer needed: buckets once all blocks are baked, splats once all tiles that use them
    /// are made. Only for a single process: it cannot know what others still read.
    bool drop_work = false;
};

/// A range of a plan's blocks.
struct BlockRange {
    std::uint32_t first = 0, end = 0;
};

struct SetPlan {
    std::string output; ///< the set's folder, NAME.proset
    std::string work;   ///< folder of intermediate files: NAME.proset.work

    Vec3d lattice_origin = Vec3d::Zero(); ///< the corner of all tiles' grids; all coordinates of cores are exact
    double edge = 1;                      ///< of level-0 cores, a power of two
    std::uint32_t levels = 1;             ///< the root is cell 0 0 0 of level levels - 1, and holds all points
    std::vector<PlanTile> tiles;          ///< partition of the points, along a Morton curve
    std::vector<std::uint32_t> first_tile_of_block; ///< [blocks + 1]

    PlanBox bounds; ///< of the kept points
    std::uint64_t points = 0;
    std::uint64_t points_read = 0, points_non_finite = 0, points_filtered = 0;
    std::uint64_t points_stray = 0; ///< dropped: too far away from all others

    PlanSchema schema;
    std::vector<PlanScan> scans;
    std::vector<PlanInput> inputs;
    WorldFrame world;               ///< up from the command line, a file or the sample
    std::string up_from, up_reason; ///< see BakeReport
    std::string source_header;
    std::vector<Note> notes;

    /// Orientation mode for tiles, which replaces bake.surface.orient. Normals that it leaves open are oriented by
    /// `sides`, if there are any.
    OrientMode orient = OrientMode::kAuto;
    PlanSides sides;
    /// Measured once points are split (writeStatistics). Noise is empty if points are too few or not to be cleaned.
    CloudStatistics statistics;

    std::string settings; ///< JSON of all options that the bytes depend on
    SetBakeOptions bake;

    std::uint32_t blocks() const { return static_cast<std::uint32_t>(first_tile_of_block.size()) - 1; }
};

/// Edge of the cores of a level, input units.
double edgeOf(const SetPlan& plan, std::uint32_t level);

/// Number of points whose splats can be estimated at once: about 250 bytes each, plus 256 MiB for the program.
/// @param max_memory memory limit of the process in bytes
std::uint64_t mostPointsAtOnce(std::uint64_t max_memory);

/// A tile's core.
PlanBox coreOf(const SetPlan& plan, const PlanTile& tile);

/// Initial width of a tile's halo, input units: wide enough for uniform density, with at most three tiles' points on a
/// surface.
double firstHalo(const SetPlan& plan, const PlanTile& tile);

/// "L-X-Y-Z", used in file names.
std::string nameOf(const PlanTile& tile);

/// A range of indices into plan.tiles.
struct TileRange {
    std::uint32_t first = 0, end = 0;
};
TileRange tilesOf(const SetPlan& plan, BlockRange blocks);

/// Indices into plan.tiles of the tiles whose cores overlap a box, ascending.
std::vector<std::uint32_t> tilesIn(const SetPlan& plan, const PlanBox& box);

/// Folders and files of a bake, in its work folder.
std::string planFile(const std::string& work); ///< plan.json
std::string bucketsFolder(const SetPlan& plan);
std::string bucketFile(const SetPlan& plan, const PlanTile& tile); ///< buckets/L-X-Y-Z.points
std::string splitMark(const SetPlan& plan);                        ///< exists once all buckets are complete
/// These exist once the step is complete and its inputs may be dropped.
std::string blocksMark(const SetPlan& plan);
std::string levelsMark(const SetPlan& plan);
std::string splatsFolder(const SetPlan& plan); ///< splats, of splat files
/// The set while it is made, with its folder tiles. Renamed to plan.output once set.json is written.
std::string finishedFolder(const std::string& work);

/// Writes plan.json atomically. The same plan gives the same bytes. Throws Error (kCannotWrite).
void writePlan(const SetPlan& plan);

/// Creates an empty file. Throws Error (kCannotWrite).
void writeMark(const std::string& path);

/// Creates a folder and its missing parents. Throws Error (kCannotWrite).
void makeFolder(const std::string& path);

/// Removes a file, or a folder with its contents, if it exists. Throws Error (kCannotWrite).
void removeTree(const std::string& path);

/// Stores the radius limit of discs, once all are known; infinity: no limit. Throws Error (kCannotWrite).
void writeWidestRadius(const SetPlan& plan, float radius);
/// nullopt before it is stored. Throws Error (kBadInput).
std::optional<float> readWidestRadius(const SetPlan& plan);

/// Stores the statistics of all points beside the plan. Throws Error (kCannotWrite).
void writeStatistics(const SetPlan& plan, const CloudStatistics& statistics);

/// Reads work + "/plan.json", without `bake`. Throws Error (kBadInput) if it is missing or invalid.
SetPlan readPlan(const std::string& work);

} // namespace pointrt

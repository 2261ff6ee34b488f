// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of pointrt-bake.
#pragma once

#include <string>
#include <vector>

#include "format/base/error.h"
#include "preprocess/input/read.h"
#include "preprocess/octree/octree.h"
#include "preprocess/surface/estimate.h"

namespace pointrt {

enum class Verbosity { kQuiet, kNormal, kDetailed };
enum class ProgressStyle { kAuto, kLines }; ///< kLines: for programs, see BakeProgress

/// A step of baking a tile set; other processes may run the other steps.
enum class SetStep { kAll, kPlan, kSplit, kBlock, kLevels, kTile, kTop };

struct TileSetOptions {
    std::uint64_t max_memory = std::uint64_t{4} << 30; ///< bytes
    std::uint64_t points_per_tile = 1'000'000;         ///< approximate
    SetStep step = SetStep::kAll;
    std::uint32_t block = 0; ///< for kBlock and kTile
    bool keep_work = false;  ///< keep the work folder after the bake
};

struct BakeOptions {
    std::vector<std::string> inputs; ///< files, or "-" for standard input
    std::string output;              ///< ends in .pro or, for a tile set, in .proset
    bool force = false;              ///< overwrite output
    int threads = 0;                 ///< 0: one per core
    std::string stats_path;          ///< JSON report; "-": standard output, "": none
    Verbosity verbosity = Verbosity::kNormal;
    ProgressStyle progress = ProgressStyle::kAuto;
    ReadOptions read{.format = "", .sample_count = std::nullopt, .scales_degrees = true, .drops_withheld = true};
    SurfaceOptions surface{.splat = SplatShape::kAuto};
    OctreeOptions octree;
    bool prune = true;
    PruneOptions pruning;
    bool index = true;        ///< write the tracing index
    float reflectivity = 0;   ///< of the material, 0 to 1
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: from the inputs
    TileSetOptions tiles;

    bool isTileSet() const { return output.ends_with(".proset"); }
};

/// Threads for all stages.
std::size_t threadCount(const BakeOptions& options);

/// Parses the command line. Returns false if help or version was printed and nothing is left to do. Throws Error
/// (kBadUsage) that names the invalid option.
bool parseOptions(int argc, char** argv, BakeOptions& options);

/// Throws Error (kBadUsage).
[[noreturn]] inline void refuseUsage(const std::string& reason) { throw Error(ExitCode::kBadUsage, reason); }

/// The word on the command line for a choice.
std::string choiceName(NormalSource source);
std::string choiceName(OrientMode mode);
std::string choiceName(SplatShape splat);

} // namespace pointrt

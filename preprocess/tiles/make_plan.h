// SPDX-License-Identifier: GPL-3.0-or-later
// The first reading of all inputs: everything that is decided once for a set.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/input/read.h"
#include "preprocess/input/stream.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// What a set is to be made of.
struct SetRequest {
    std::vector<std::string> inputs; ///< files
    std::string output;              ///< NAME.proset
    ReadOptions read;
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: as the inputs say, else as the sample shows
    std::uint64_t points_per_tile = 1'000'000;
    SetBakeOptions bake;
    std::string settings; ///< JSON of all options that the bytes depend on
};

/// The folder of a set's steps: NAME.proset.work.
std::string workFolderOf(const std::string& output);

/// Reads all inputs once and decides. The same for any number of threads. Throws Error as readInBatches and
/// estimateSplats do, and (kBadUsage) for what sets cannot do.
SetPlan makePlan(const SetRequest& request, const ReadProgress& progress = {});

/// What of a request cannot be done for sets. Throws Error (kBadUsage).
void requirePossible(const SetRequest& request);

/// How the readings of a request are to be.
StreamOptions streamOptionsOf(const SetRequest& request);

/// Bytes that a set takes, about, as measured.
struct SpaceNeeded {
    std::uint64_t temporary = 0, final = 0;
    std::uint64_t peak = 0; ///< at once
};
SpaceNeeded spaceNeeded(const SetPlan& plan);
std::string spaceLine(const SetPlan& plan); ///< for people

/// Throws Error (kCannotWrite) where the disk of plan.output has less room than that.
void requireSpace(const SetPlan& plan);

/// Throws Error (kBadUsage, one line that says which) where a plan was made with other options.
void requireSameRequest(const SetPlan& plan, const SetRequest& request);

} // namespace pointrt

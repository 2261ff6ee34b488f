// SPDX-License-Identifier: GPL-3.0-or-later
// The first pass over all inputs, which makes all decisions for a set.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/input/read.h"
#include "preprocess/input/stream.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// A request to bake a set.
struct SetRequest {
    std::vector<std::string> inputs; ///< files
    std::string output;              ///< NAME.proset
    ReadOptions read;
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: from the inputs or, failing that, the sample
    std::uint64_t points_per_tile = 1'000'000;
    SetBakeOptions bake;
    std::string settings; ///< JSON of all options that the bytes depend on
};

/// The folder of a set's steps: NAME.proset.work.
std::string workFolderOf(const std::string& output);

/// Reads all inputs once and makes the plan. The same for any number of threads. Throws Error as readInBatches and
/// estimateSplats do, and (kBadUsage) for requests that sets do not support.
SetPlan makePlan(const SetRequest& request, const ReadProgress& progress = {});

/// Throws Error (kBadUsage) if a request is not supported for sets.
void requirePossible(const SetRequest& request);

/// Options of both passes.
StreamOptions streamOptionsOf(const SetRequest& request);

/// Estimated disk space of a set in bytes.
struct SpaceNeeded {
    std::uint64_t temporary = 0, final = 0;
    std::uint64_t peak = 0; ///< largest total at any time
};
SpaceNeeded spaceNeeded(const SetPlan& plan);
std::string spaceLine(const SetPlan& plan); ///< for people

/// Throws Error (kCannotWrite) if the disk of plan.output has less free space than that.
void requireSpace(const SetPlan& plan);

/// Throws Error (kBadUsage, one line naming the option) if the plan was made with other options.
void requireSameRequest(const SetPlan& plan, const SetRequest& request);

} // namespace pointrt

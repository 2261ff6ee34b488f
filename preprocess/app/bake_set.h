// SPDX-License-Identifier: GPL-3.0-or-later
// The road from scan files to a tile set, in steps that other processes may share.
#pragma once

#include <string>
#include <vector>

#include "preprocess/app/options.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// What a step did.
struct SetStepReport {
    std::string step;
    std::uint64_t points = 0, bytes = 0; ///< that it went through, that it has written
    double seconds = 0;
};

struct SetReport {
    SetPlan plan;
    std::vector<SetStepReport> steps;    ///< those of this process
    std::uint64_t splats = 0, tiles = 0; ///< of the set, where it is done; all levels' tiles
    std::uint64_t bytes = 0;
    std::uint64_t points_lacking_neighbors = 0; ///< TileCounts::lacking, of the blocks this process did
    bool done = false;                          ///< the set stands under its name
    double seconds_total = 0;
};

/// Does options.tiles.step, or all that is left to do. What is done already is not done again, whoever did it and
/// wherever that stopped; the bytes are the same. Throws Error.
SetReport bakeSet(const BakeOptions& options);

/// One line for people.
std::string summaryLine(const SetReport& report);

/// Writes the report as JSON to path ("-" is standard output). Throws Error (kCannotWrite).
void writeStats(const SetReport& report, const std::string& path);

} // namespace pointrt

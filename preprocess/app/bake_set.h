// SPDX-License-Identifier: GPL-3.0-or-later
// Bakes scan files to a tile set, in steps that several processes can share.
#pragma once

#include <string>
#include <vector>

#include "preprocess/app/options.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// The work of one step.
struct SetStepReport {
    std::string step;
    std::uint64_t points = 0, bytes = 0; ///< processed, written
    double seconds = 0;
};

struct SetReport {
    SetPlan plan;
    std::vector<SetStepReport> steps;    ///< run by this process
    std::uint64_t splats = 0, tiles = 0; ///< of the finished set, all levels
    std::uint64_t bytes = 0;
    std::uint64_t points_lacking_neighbors = 0; ///< TileCounts::lacking, for the blocks of this process
    std::uint64_t balls = 0;                    ///< likewise
    bool done = false;                          ///< the set has its final name
    double seconds_total = 0;
};

/// Runs options.tiles.step, or all remaining steps. Skips work that any process has finished before; the bytes of the
/// set do not depend on that. Throws Error.
SetReport bakeSet(const BakeOptions& options);

/// One line for the user.
std::string summaryLine(const SetReport& report);

/// Writes the report as JSON to path ("-" is standard output). Throws Error (kCannotWrite).
void writeStats(const SetReport& report, const std::string& path);

} // namespace pointrt

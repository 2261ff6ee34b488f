// SPDX-License-Identifier: GPL-3.0-or-later
// The second pass over all inputs: sorts their points into the buckets of tiles.
#pragma once

#include "preprocess/tiles/make_plan.h"

namespace pointrt {

struct SplitOptions {
    /// The progress is saved after a file once this many points were added since the last time; a split that was killed
    /// resumes from there.
    std::uint64_t points_between_marks = std::uint64_t{1} << 24;
};

/// Whether all buckets are complete.
bool isSplit(const SetPlan& plan);

/// Fills the buckets, unless they are complete, and measures the statistics of all points (writeStatistics). The same
/// bytes for any number of threads, and after having been killed at any moment. Throws Error as readInBatches does,
/// with kBadInput if inputs have other points than when the plan was made, and kCannotWrite if the disk is full.
void splitPoints(const SetPlan& plan, const SetRequest& request, const ReadProgress& progress = {},
                 const SplitOptions& options = {});

} // namespace pointrt

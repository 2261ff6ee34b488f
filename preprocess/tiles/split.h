// SPDX-License-Identifier: GPL-3.0-or-later
// The second reading of all inputs: their points to the buckets of their tiles.
#pragma once

#include "preprocess/tiles/make_plan.h"

namespace pointrt {

struct SplitOptions {
    /// After the file that brings as many points since the last time it is taken down how far the buckets are, and a
    /// split that was killed goes on from there.
    std::uint64_t points_between_marks = std::uint64_t{1} << 24;
};

/// Whether all buckets are whole.
bool isSplit(const SetPlan& plan);

/// Fills the buckets, where they are not whole yet, and measures the noise of the scans (SetPlan::noise, in its file).
/// The same bytes for any number of threads, and after having been killed at any moment. Throws Error as readInBatches
/// does, (kBadInput) where inputs hold other points than when the plan was made, (kCannotWrite) where the disk is full.
void splitPoints(const SetPlan& plan, const SetRequest& request, const ReadProgress& progress = {},
                 const SplitOptions& options = {});

} // namespace pointrt

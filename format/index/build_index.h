// SPDX-License-Identifier: Apache-2.0
// Builds the tracing index of a .pro from its octree: the same words for the file and for a device.
#pragma once

#include "format/index/bricks.h"
#include "format/index/entry_grid.h"
#include "pointrt/pro.h"

namespace pointrt {

/// Version of the output of buildTracingIndex. Increase it if the same octree gives other words, so that cached indices
/// (runtime/device_scene) are rebuilt.
constexpr unsigned kIndexVersion = 1;

struct TracingIndex {
    EntryGrid grid;
    Bricks bricks; ///< without corners
};

/// Builds the index for the content of a validated file. The words do not depend on the number of threads.
/// Throws std::bad_alloc, or Error (kCannotRun) if too many discs overlap for the limits of the index.
TracingIndex buildTracingIndex(const pro_info& info, const pro_view& view, const IndexOptions& options = {});

/// A view for pro_write_content; points into index.
pro_index indexView(const TracingIndex& index);

} // namespace pointrt

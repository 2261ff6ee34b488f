// SPDX-License-Identifier: Apache-2.0
// The tracing index of a .pro, from its octree: the same words whether they go into the file or straight to a device.
#pragma once

#include "format/index/bricks.h"
#include "format/index/entry_grid.h"
#include "pointrt/pro.h"

namespace pointrt {

/// Of what buildTracingIndex makes: to be raised where the same octree gets other words, so that indices that were kept
/// (runtime/device_scene) are built anew.
constexpr unsigned kIndexVersion = 1;

struct TracingIndex {
    EntryGrid grid;
    Bricks bricks; ///< without corners
};

/// Builds the index of a validated file's content. The words do not depend on the number of threads.
/// Throws std::bad_alloc, or Error (kCannotRun) where discs crowd so that the index cannot hold them.
TracingIndex buildTracingIndex(const pro_info& info, const pro_view& view, const IndexOptions& options = {});

/// For pro_write_indexed; points into index.
pro_index indexView(const TracingIndex& index);

} // namespace pointrt

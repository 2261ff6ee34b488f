// SPDX-License-Identifier: Apache-2.0
// Tracing indices of files without one, once built: kept as .pro files with the same octree, so that what is kept
// passes the same checks as what is shipped.
#pragma once

#include <cstdint>
#include <string>

#include "pointrt/pro.h"
#include "runtime/device_scene/kept_files.h"

namespace pointrt {

/// What is kept where nothing is said: of some 80 million splats.
constexpr std::uint64_t kIndexStoreBytes = std::uint64_t{8} << 30;

/// $XDG_CACHE_HOME/pointrt/index, or ~/.cache/pointrt/index; as large as POINTRT_INDEX_CACHE says, a size such as 20G
/// or "off". Throws Error kBadUsage where that is neither.
KeptFiles userIndexStore();

/// The index kept for a mapped file that has none: a file with its octree, to be closed by the caller. Null where there
/// is none, or what is there is damaged or of another file.
pro_file* openKeptIndex(const KeptFiles& store, const pro_file* file);

/// Keeps an index that was built for a mapped file, in place of what was kept for it. "", or why it cannot be kept.
std::string keepIndex(const KeptFiles& store, const pro_file* file, const pro_index& index);

} // namespace pointrt

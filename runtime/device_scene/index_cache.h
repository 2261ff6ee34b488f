// SPDX-License-Identifier: Apache-2.0
// The user's cache of tracing indices, for files without one. Cached as .pro files with the same octree, so that they
// pass the same checks as other files.
#pragma once

#include <cstdint>
#include <string>

#include "pointrt/pro.h"
#include "runtime/device_scene/file_cache.h"

namespace pointrt {

/// Default size limit, bytes: the indices of some 80 million splats.
constexpr std::uint64_t kIndexCacheBytes = std::uint64_t{8} << 30;

/// $XDG_CACHE_HOME/pointrt/index, or ~/.cache/pointrt/index. POINTRT_INDEX_CACHE sets the size limit, such as 20G, or
/// "off". Throws Error kBadUsage if it is neither.
FileCache userIndexCache();

/// The cached file with the index of a mapped file; the caller closes it. Null if there is none, or if it is damaged or
/// belongs to another file.
pro_file* openCachedIndex(const FileCache& cache, const pro_file* file);

/// Caches the index built for a mapped file, replacing the previous one. Returns "" or why it could not be cached.
std::string cacheIndex(const FileCache& cache, const pro_file* file, const pro_index& index);

} // namespace pointrt

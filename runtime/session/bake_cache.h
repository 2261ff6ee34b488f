// SPDX-License-Identifier: Apache-2.0
// The user's cache of baked scans: pointrt-bake runs once for the same scans and options.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "runtime/device_scene/file_cache.h"
#include "runtime/session/bake_key.h"

namespace pointrt {

/// Default size limit, bytes: some 400 million splats at 50 bytes each.
constexpr std::uint64_t kBakeCacheBytes = std::uint64_t{20} << 30;

/// $XDG_CACHE_HOME/pointrt/bakes, or ~/.cache/pointrt/bakes. POINTRT_BAKE_CACHE sets the size limit, such as 50G, or
/// "off". Throws Error kBadUsage if it is neither.
FileCache userBakeCache();

/// Callbacks that watch a bake. All are called on the thread that bakes; any but progress may be empty.
struct BakeMonitor {
    std::function<bool()> cancelled;
    std::function<void(double share, const std::string& stage)> progress;
    std::function<void(const std::string& line)> remark; ///< receives the notes and warnings of pointrt-bake
};

/// The path of the baked scans: from the cache, or baked into it by a child process. If another process runs the same
/// bake, waits for that. If the cache grows too large, deletes the least recently used bakes, but never this one. "" if
/// cancelled. Throws Error with the reason given by pointrt-bake, or kCannotWrite without a cache folder.
/// @param tool path of pointrt-bake
std::string bakeCached(const FileCache& cache, const ScanBake& bake, const std::string& tool,
                       const BakeMonitor& monitor);

/// Path of the cached bake of these scans; empty if they have not been baked. Throws Error as bakeKey does.
std::string findBake(const FileCache& cache, const ScanBake& bake, const std::string& tool, const BakeMonitor& monitor);

/// Whether path is a file of the cache, which may be deleted at any time.
bool isCachedBake(const FileCache& cache, const std::string& path);

/// "a.ply and 2 more".
std::string describeScans(const std::vector<std::string>& scans);

} // namespace pointrt

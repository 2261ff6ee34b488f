// SPDX-License-Identifier: Apache-2.0
// A folder of files that can be recreated; the least recently used are deleted when it grows too large.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pointrt {

/// The folder takes at most a quarter of the disk space that would be free without it.
constexpr std::uint64_t kFreePerCached = 4;

/// A folder that several processes may share. Only files with the suffix and their temporary files (AtomicFile) belong
/// to the cache; old temporary files are leftovers.
struct FileCache {
    std::string folder; ///< empty: caching is off
    std::string suffix;
    std::uint64_t most_bytes = 0;
};

/// The name of a cache in the user's cache folder, and the environment variable that limits its size.
struct UserCache {
    const char* name;             ///< of its folder in $XDG_CACHE_HOME/pointrt or ~/.cache/pointrt
    const char* suffix;           ///< of its files
    const char* variable;         ///< a size limit such as 20G, or "off"
    std::uint64_t most_bytes = 0; ///< limit if the variable is not set
};

/// The result has no folder if caching is off or the user has no cache folder. Throws Error kBadUsage if the variable
/// is neither a size nor "off".
FileCache userFileCache(const UserCache& user);

/// Creates the folder, accessible only to the user, if it is missing, and deletes the least recently used files until
/// `bytes` more fit. False if there is no folder, or that many cannot fit. kept: path of a file that is not deleted.
bool makeRoomFor(const FileCache& cache, std::uint64_t bytes, const std::string& kept = {});

/// Marks a file as used now; ignored if it cannot be written.
void markUsed(const std::string& path);

} // namespace pointrt

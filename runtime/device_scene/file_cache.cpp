// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/file_cache.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "format/base/error.h"
#include "format/os/environment.h"
#include "format/os/folder.h"
#include "format/os/user_folder.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

struct CachedFile {
    fs::path path;
    std::uint64_t bytes = 0;
    fs::file_time_type used;
};

bool isCached(const FileCache& cache, const std::string& name) {
    return name.ends_with(cache.suffix) || name.find(cache.suffix + ".tmp-") != std::string::npos;
}

/// Least recently used first. Other processes may delete files meanwhile.
std::vector<CachedFile> filesOf(const FileCache& cache) {
    std::vector<CachedFile> files;
    std::error_code error;
    for (const fs::path path : listFolder(cache.folder, error)) {
        std::error_code gone;
        if (!isCached(cache, path.filename().string()) || !fs::is_regular_file(path, gone)) continue;
        const CachedFile file{path, fs::file_size(path, gone), fs::last_write_time(path, gone)};
        if (!gone) files.push_back(file);
    }
    std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) { return a.used < b.used; });
    return files;
}

/// The limit for the folder, which already holds `there` bytes.
std::uint64_t roomOf(const FileCache& cache, std::uint64_t there) {
    std::error_code unknown;
    const fs::space_info disk = fs::space(cache.folder, unknown);
    return unknown ? 0 : std::min<std::uint64_t>(cache.most_bytes, (there + disk.available) / kFreePerCached);
}

} // namespace

FileCache userFileCache(const UserCache& user) {
    FileCache cache{userCacheFolder(), user.suffix, user.most_bytes};
    const std::string size = environmentVariable(user.variable);
    if (size == "off") cache.folder.clear();
    if (!cache.folder.empty()) cache.folder += std::string("/") + user.name;
    if (size.empty() || size == "off") return cache;
    try {
        cache.most_bytes = parseBytes(size);
    } catch (const std::invalid_argument& error) {
        throw Error(ExitCode::kBadUsage, std::string(user.variable) + ": " + error.what() + ", or off");
    }
    return cache;
}

bool makeRoomFor(const FileCache& cache, std::uint64_t bytes, const std::string& kept) {
    if (cache.folder.empty() || !makePrivateFolder(cache.folder)) return false;
    const std::vector<CachedFile> files = filesOf(cache);
    std::uint64_t there = 0;
    for (const CachedFile& file : files) there += file.bytes;
    const std::uint64_t room = roomOf(cache, there);
    if (bytes > room) return false;
    for (const CachedFile& file : files) {
        if (there + bytes <= room) break;
        if (file.path == kept) continue;
        std::error_code gone; // ignored: another process may have deleted it
        fs::remove(file.path, gone);
        there -= file.bytes;
    }
    return true;
}

void markUsed(const std::string& path) {
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
}

} // namespace pointrt

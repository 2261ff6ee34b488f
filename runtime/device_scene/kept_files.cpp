// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/kept_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

namespace pointrt {
namespace {

namespace fs = std::filesystem;

struct KeptFile {
    fs::path path;
    std::uint64_t bytes = 0;
    fs::file_time_type used;
};

bool isKept(const KeptFiles& kept, const std::string& name) {
    return name.ends_with(kept.suffix) || name.find(kept.suffix + ".tmp-") != std::string::npos;
}

/// The longest unused first. Others may take files away meanwhile.
std::vector<KeptFile> filesOf(const KeptFiles& kept) {
    std::vector<KeptFile> files;
    std::error_code error;
    for (fs::directory_iterator entry(kept.folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code gone;
        if (!isKept(kept, entry->path().filename().string()) || !entry->is_regular_file(gone)) continue;
        const KeptFile file{entry->path(), entry->file_size(gone), entry->last_write_time(gone)};
        if (!gone) files.push_back(file);
    }
    std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
    return files;
}

/// As the XDG base directory specification asks for, each folder that is missing is made for the user alone.
bool makeFolder(const fs::path& folder) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) return true;
    constexpr mode_t kUserAlone = 0700;
    const fs::path above = folder.parent_path();
    if (above.empty() || above == folder || !makeFolder(above)) return false;
    return mkdir(folder.c_str(), kUserAlone) == 0 || errno == EEXIST;
}

/// With what is there already.
std::uint64_t roomOf(const KeptFiles& kept, std::uint64_t there) {
    std::error_code unknown;
    const fs::space_info disk = fs::space(kept.folder, unknown);
    return unknown ? 0 : std::min<std::uint64_t>(kept.most_bytes, (there + disk.available) / kKeptShareOfFree);
}

} // namespace

bool makeRoomFor(const KeptFiles& kept, std::uint64_t bytes) {
    if (kept.folder.empty() || !makeFolder(kept.folder)) return false;
    const std::vector<KeptFile> files = filesOf(kept);
    std::uint64_t there = 0;
    for (const KeptFile& file : files) there += file.bytes;
    const std::uint64_t room = roomOf(kept, there);
    if (bytes > room) return false;
    for (const KeptFile& file : files) {
        if (there + bytes <= room) break;
        std::error_code gone; // another process took it
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

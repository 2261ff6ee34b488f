// SPDX-License-Identifier: Apache-2.0
#include "format/os/user_folder.h"
#include "format/os/environment.h"

#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// The specification says to ignore relative paths.
std::string absoluteFrom(const char* variable) {
    const std::string value = environmentVariable(variable);
    return value.starts_with('/') ? value : "";
}

std::string userFolder(const char* variable, const char* below_home) {
    if (const std::string folder = absoluteFrom(variable); !folder.empty()) return folder + "/pointrt";
    const std::string home = absoluteFrom("HOME");
    return home.empty() ? home : home + below_home + "/pointrt";
}

} // namespace

std::string userCacheFolder() { return userFolder("XDG_CACHE_HOME", "/.cache"); }

std::string userStateFolder() { return userFolder("XDG_STATE_HOME", "/.local/state"); }

bool makePrivateFolder(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return true;
    constexpr mode_t kUserAlone = 0700;
    const fs::path above = fs::path(path).parent_path();
    if (above.empty() || above == path || !makePrivateFolder(above.string())) return false;
    return mkdir(path.c_str(), kUserAlone) == 0 || errno == EEXIST;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/os/user_folder.h"

#include "format/os/environment.h"
#include "format/os/wide_path_windows.h"

#include <filesystem>
#include <system_error>

namespace pointrt {
namespace {

std::string userFolder(const std::string& below) {
    const std::string above = environmentVariable("LOCALAPPDATA");
    return above.empty() ? above : (std::filesystem::path(above) / "pointrt" / below).string();
}

} // namespace

std::string userCacheFolder() { return userFolder("cache"); }

std::string userStateFolder() { return userFolder("state"); }

/// The folders above belong to the user only, and new folders inherit their rights.
bool makePrivateFolder(const std::string& path) {
    std::error_code ignored;
    std::filesystem::create_directories(format::widePath(path), ignored);
    return std::filesystem::is_directory(format::widePath(path), ignored);
}

} // namespace pointrt

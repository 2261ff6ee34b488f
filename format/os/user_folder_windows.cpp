// SPDX-License-Identifier: Apache-2.0
#include "format/os/user_folder.h"

#include "format/os/wide_path_windows.h"

#include <array>
#include <filesystem>
#include <system_error>

namespace pointrt {
namespace {

std::string userFolder(const wchar_t* below) {
    std::array<wchar_t, 32768> value{}; // the longest variable
    const DWORD length = GetEnvironmentVariableW(L"LOCALAPPDATA", value.data(), static_cast<DWORD>(value.size()));
    if (length == 0 || length >= value.size()) return {};
    return format::narrowPath((std::filesystem::path(value.data()) / "pointrt" / below).wstring());
}

} // namespace

std::string userCacheFolder() { return userFolder(L"cache"); }

std::string userStateFolder() { return userFolder(L"state"); }

/// The folders above are the user's alone, and folders have the rights of the one that they are in.
bool makePrivateFolder(const std::string& path) {
    std::error_code ignored;
    std::filesystem::create_directories(format::widePath(path), ignored);
    return std::filesystem::is_directory(format::widePath(path), ignored);
}

} // namespace pointrt

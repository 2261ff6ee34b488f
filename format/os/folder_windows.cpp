// SPDX-License-Identifier: Apache-2.0
#include "format/os/folder.h"

#include "format/os/wide_path_windows.h"

#include <string_view>

namespace pointrt {
namespace {

std::error_code lastError() { return {static_cast<int>(GetLastError()), std::system_category()}; }

void removeOne(const std::wstring& path, DWORD attributes, std::error_code& failure) {
    const bool is_folder = (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    if ((is_folder ? RemoveDirectoryW(path.c_str()) : DeleteFileW(path.c_str())) == 0) failure = lastError();
}

} // namespace

std::vector<std::string> listFolder(const std::string& folder, std::error_code& failure) {
    failure.clear();
    WIN32_FIND_DATAW found;
    const HANDLE search = FindFirstFileW(format::widePath(folder + "/*").c_str(), &found);
    std::vector<std::string> paths;
    if (search == INVALID_HANDLE_VALUE) {
        failure = lastError();
        return paths;
    }
    do {
        const std::wstring_view name = found.cFileName;
        if (name != L"." && name != L"..") paths.push_back(folder + "/" + format::narrowPath(found.cFileName));
    } while (FindNextFileW(search, &found) != 0);
    FindClose(search);
    return paths;
}

/// Links to folders are deleted, not followed.
void removeAll(const std::string& path, std::error_code& failure) {
    failure.clear();
    const std::wstring wide = format::widePath(path);
    const DWORD attributes = GetFileAttributesW(wide.c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES) {
        const DWORD error = GetLastError();
        if (error != ERROR_FILE_NOT_FOUND && error != ERROR_PATH_NOT_FOUND) failure = lastError();
        return;
    }
    if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0 && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0)
        for (const std::string& each : listFolder(path, failure)) {
            removeAll(each, failure);
            if (failure) return;
        }
    if (!failure) removeOne(wide, attributes, failure);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/os/swap_names.h"

#include "format/os/wide_path_windows.h"

#include <cerrno>

namespace pointrt {

bool swapNames(const std::string&, const std::string&) {
    errno = ENOSYS;
    return false;
}

/// The C library's rename does not support paths of more than 260 characters.
bool renameFolder(const std::string& folder, const std::string& name) {
    if (MoveFileExW(format::widePath(folder).c_str(), format::widePath(name).c_str(), 0) != 0) return true;
    const DWORD error = GetLastError();
    const bool is_taken = error == ERROR_ALREADY_EXISTS || error == ERROR_FILE_EXISTS;
    errno = is_taken ? EEXIST : error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION ? EACCES : ENOENT;
    return false;
}

} // namespace pointrt

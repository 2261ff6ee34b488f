// SPDX-License-Identifier: Apache-2.0
#include "format/os/swap_names.h"

#include <fcntl.h>
#include <stdio.h>

namespace pointrt {

bool swapNames(const std::string& one, const std::string& other) {
    return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

bool renameFolder(const std::string& folder, const std::string& name) {
    return ::rename(folder.c_str(), name.c_str()) == 0;
}

} // namespace pointrt

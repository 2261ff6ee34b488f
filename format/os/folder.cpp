// SPDX-License-Identifier: Apache-2.0
#include "format/os/folder.h"

#include <filesystem>

namespace pointrt {

namespace fs = std::filesystem;

std::vector<std::string> listFolder(const std::string& folder, std::error_code& failure) {
    std::vector<std::string> paths;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
        paths.push_back(entry->path().string());
    return paths;
}

void removeAll(const std::string& path, std::error_code& failure) { fs::remove_all(path, failure); }

} // namespace pointrt

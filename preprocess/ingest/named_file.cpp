// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/named_file.h"

#include <algorithm>

#include "format/os/folder.h"

namespace pointrt {

namespace fs = std::filesystem;

std::optional<fs::path> pathInFolder(const fs::path& folder, const std::string& name) {
    std::error_code failure;
    const fs::path root = fs::canonical(folder.empty() ? "." : folder, failure);
    const fs::path real = failure ? fs::path() : fs::weakly_canonical(root / name, failure);
    const bool inside =
        !failure && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
    if (!inside) return std::nullopt;
    return folder / name;
}

std::vector<std::string> filesOfFolder(const fs::path& folder) {
    std::error_code failure;
    std::vector<std::string> paths = listFolder(folder.empty() ? "." : folder.string(), failure);
    std::erase_if(paths, [](const std::string& path) {
        std::error_code gone;
        return !fs::is_regular_file(path, gone);
    });
    return paths;
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/named_file.h"

#include <algorithm>

namespace pointrt {

std::optional<std::filesystem::path> pathInFolder(const std::filesystem::path& folder, const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code failure;
    const fs::path root = fs::canonical(folder.empty() ? "." : folder, failure);
    const fs::path real = failure ? fs::path() : fs::weakly_canonical(root / name, failure);
    const bool inside =
        !failure && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
    if (!inside) return std::nullopt;
    return folder / name;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/os/find_program.h"

#include <algorithm>
#include <filesystem>

#include "format/os/program.h"

namespace pointrt {

std::string findProgram(const std::string& name, const std::string& search_path) {
    for (std::size_t at = 0; at < search_path.size();) {
        const std::size_t end = std::min(search_path.find(kSearchPathSeparator, at), search_path.size());
        const std::string path = (std::filesystem::path(search_path.substr(at, end - at)) / programFile(name)).string();
        if (end > at && isProgram(path)) return path;
        at = end + 1;
    }
    return {};
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/bake_tool.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "format/base/error.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

} // namespace

std::string findBakeTool(const std::string& folder, const std::string& search_path) {
    const std::string beside = (fs::path(folder) / kBakeTool).string();
    if (isProgram(beside)) return beside;
    for (std::size_t at = 0; at < search_path.size();) {
        const std::size_t end = std::min(search_path.find(':', at), search_path.size());
        const std::string path = (fs::path(search_path.substr(at, end - at)) / kBakeTool).string();
        if (end > at && isProgram(path)) return path;
        at = end + 1;
    }
    throw Error{ExitCode::kCannotRun, std::string(kBakeTool) + ", which bakes scans, is neither in " + folder +
                                          " nor in PATH (" + search_path + ")"};
}

std::string findBakeTool() {
    std::error_code ignored;
    const char* path = std::getenv("PATH");
    return findBakeTool(fs::read_symlink("/proc/self/exe", ignored).parent_path().string(), path ? path : "");
}

} // namespace pointrt

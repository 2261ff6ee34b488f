// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/bake_tool.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "format/base/error.h"
#include "format/os/program.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

} // namespace

std::string findBakeTool(const std::string& folder, const std::string& search_path) {
    const std::string beside = (fs::path(folder) / programFile(kBakeTool)).string();
    if (isProgram(beside)) return beside;
    for (std::size_t at = 0; at < search_path.size();) {
        const std::size_t end = std::min(search_path.find(kSearchPathSeparator, at), search_path.size());
        const std::string path = (fs::path(search_path.substr(at, end - at)) / programFile(kBakeTool)).string();
        if (end > at && isProgram(path)) return path;
        at = end + 1;
    }
    throw Error{ExitCode::kCannotRun, std::string(kBakeTool) + ", which bakes scans, is neither in " + folder +
                                          " nor in PATH (" + search_path + ")"};
}

std::string findBakeTool() {
    const char* path = std::getenv("PATH");
    return findBakeTool(fs::path(programPath()).parent_path().string(), path ? path : "");
}

} // namespace pointrt

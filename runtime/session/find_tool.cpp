// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/find_tool.h"

#include <filesystem>

#include "format/base/error.h"
#include "format/os/environment.h"
#include "format/os/find_program.h"
#include "format/os/program.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

} // namespace

std::string findTool(const std::string& name, const std::string& folder, const std::string& search_path) {
    const std::string beside = (fs::path(folder) / programFile(name)).string();
    if (isProgram(beside)) return beside;
    const std::string path = findProgram(name, search_path);
    if (!path.empty()) return path;
    throw Error{ExitCode::kCannotRun, name + " is neither in " + folder + " nor in PATH (" + search_path + ")"};
}

std::string findTool(const std::string& name) {
    return findTool(name, fs::path(programPath()).parent_path().string(), environmentVariable("PATH"));
}

} // namespace pointrt

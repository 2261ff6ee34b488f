// SPDX-License-Identifier: Apache-2.0
#include "format/os/program.h"

#include <errno.h> // program_invocation_name, of GNU
#include <unistd.h>

#include <filesystem>
#include <system_error>

namespace pointrt {

namespace fs = std::filesystem;

std::string programPath() {
    std::error_code ignored;
    const fs::path running = fs::read_symlink("/proc/self/exe", ignored);
    // packaging/launch.sh starts the program through its own loader, under the script's path
    const bool is_loader = running.filename().string().starts_with("ld-linux");
    return is_loader ? program_invocation_name : running.string();
}

std::string programFile(const std::string& name) { return name; }

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

std::string plainPath(const std::string& path) { return path; }

const char kSearchPathSeparator = ':';

} // namespace pointrt

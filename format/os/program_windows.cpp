// SPDX-License-Identifier: Apache-2.0
#include "format/os/program.h"

#include "format/os/wide_path_windows.h"

#include <filesystem>
#include <system_error>

/// Tells the C library of mingw-w64 to expand * and ? in arguments, as shells do elsewhere.
extern "C" {
int _dowildcard = -1;
}

namespace pointrt {

std::string programPath() {
    constexpr std::size_t kLongest = 32768; // longest path of Windows, in characters
    std::wstring path(kLongest, 0);
    path.resize(GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())));
    return format::narrowPath(path);
}

std::string programFile(const std::string& name) { return name + ".exe"; }

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(format::widePath(path), ignored);
}

/// \\?\C:\scan.las is C:\scan.las, and \\?\UNC\server\scan.las is \\server\scan.las. Other names keep the prefix.
std::string plainPath(const std::string& path) {
    const std::string prefix = R"(\\?\)", share = prefix + R"(UNC\)";
    if (path.starts_with(share)) return R"(\\)" + path.substr(share.size());
    const bool has_drive =
        path.starts_with(prefix) && path.size() > prefix.size() + 1 && path[prefix.size() + 1] == ':';
    return has_drive ? path.substr(prefix.size()) : path;
}

const char kSearchPathSeparator = ';';

} // namespace pointrt

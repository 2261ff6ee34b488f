// SPDX-License-Identifier: Apache-2.0
#include "format/os/program.h"

#include "format/os/wide_path_windows.h"

#include <filesystem>
#include <system_error>

namespace pointrt {

std::string programPath() {
    constexpr std::size_t kLongest = 32768; // of a path of Windows
    std::wstring path(kLongest, 0);
    path.resize(GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())));
    return format::narrowPath(path);
}

std::string programFile(const std::string& name) { return name + ".exe"; }

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(format::widePath(path), ignored);
}

const char kSearchPathSeparator = ';';

} // namespace pointrt

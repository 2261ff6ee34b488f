// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/recent_files.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "format/base/error.h"
#include "format/os/user_folder.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// As many as fit in the window without scrolling.
constexpr std::size_t kMaxFiles = 10;

std::string listPath(const std::string& folder) { return folder + "/recent"; }

} // namespace

std::vector<std::string> recentFiles(const std::string& folder) {
    std::vector<std::string> files;
    if (folder.empty()) return files;
    std::ifstream list(listPath(folder));
    std::error_code ignored;
    for (std::string line; files.size() < kMaxFiles && std::getline(list, line);)
        if (line.starts_with('/') && fs::exists(line, ignored)) files.push_back(line);
    return files;
}

void addRecentFile(const std::string& folder, const std::string& path) {
    std::error_code error;
    const std::string added = fs::absolute(path, error).lexically_normal().string();
    if (folder.empty() || error || added.find('\n') != std::string::npos || !makePrivateFolder(folder)) return;
    std::vector<std::string> files = recentFiles(folder);
    std::erase(files, added);
    files.insert(files.begin(), added);
    if (files.size() > kMaxFiles) files.pop_back();
    std::string text;
    for (const std::string& file : files) text += file + "\n";
    try {
        writeFile(listPath(folder), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    } catch (const Error&) {
        return; // the list stays unchanged
    }
}

} // namespace pointrt

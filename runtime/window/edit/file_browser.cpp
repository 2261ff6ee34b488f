// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_browser.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>

#include "format/os/folder.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/window/edit/file_list.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// Suffixes of pictures, videos, documents and programs that may lie beside scans. Files with any other name may be
/// scans.
constexpr std::string_view kNoScans[] = {".png",  ".jpg",  ".jpeg", ".exr", ".webp", ".gif",     ".bmp", ".mp4",
                                         ".webm", ".mov",  ".svg",  ".dxf", ".dwg",  ".geojson", ".pdf", ".md",
                                         ".html", ".docx", ".xlsx", ".zip", ".gz",   ".7z",      ".deb", ".exe",
                                         ".dll",  ".so",   ".py",   ".sh",  ".cpp",  ".h",       ".log"};

bool maybeScan(const std::string& name) {
    std::string suffix = fs::path(name).extension().string();
    std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::ranges::find(kNoScans, suffix) == std::end(kNoScans);
}

bool comesBefore(const FileBrowser::Entry& a, const FileBrowser::Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : naturallyLess(a.name, b.name);
}

} // namespace

bool isToOpen(const std::string& path) {
    std::error_code ignored;
    return fs::exists(path, ignored) && (!fs::is_directory(path, ignored) || isSceneOrSet(path));
}

FileBrowser browse(const std::string& folder) {
    std::error_code error;
    FileBrowser browser;
    browser.folder = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal().string();
    for (const std::string& path : listFolder(browser.folder, error)) {
        const std::string name = fs::path(path).filename().string();
        std::error_code ignored;
        const bool is_folder = fs::is_directory(path, ignored) && !isSceneOrSet(path);
        if (!name.starts_with('.') && (is_folder || maybeScan(name)))
            browser.entries.push_back({name, is_folder, false});
    }
    if (error) browser.error = browser.folder + ": " + error.message();
    std::sort(browser.entries.begin(), browser.entries.end(), comesBefore);
    return browser;
}

std::vector<std::string> chosenFiles(const FileBrowser& browser) {
    std::vector<std::string> paths;
    for (const FileBrowser::Entry& entry : browser.entries)
        if (entry.chosen && !entry.is_folder) paths.push_back((fs::path(browser.folder) / entry.name).string());
    return paths;
}

} // namespace pointrt

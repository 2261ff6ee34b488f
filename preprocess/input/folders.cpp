// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/folders.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "format/base/error.h"
#include "format/os/folder.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/gaussian/sog_files.h"
#include "preprocess/input/points/colmap.h"
#include "preprocess/input/points/octree_folder.h"
#include "preprocess/input/points/xyz_layout.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// Limit of nested folders.
constexpr int kDeepest = 16;

std::vector<std::string> filesIn(const std::string& folder, int depth);

std::vector<std::string> listed(const std::string& folder) {
    std::error_code failure;
    std::vector<std::string> paths = listFolder(folder, failure);
    if (failure) throw Error(ExitCode::kBadInput, folder + ": " + failure.message());
    std::erase_if(paths, [](const std::string& path) { return fs::path(path).filename().string().starts_with('.'); });
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// The files of the subfolders; does not follow links.
std::vector<std::string> filesBelow(const std::string& folder, int depth) {
    std::vector<std::string> files;
    std::error_code unreadable;
    for (const std::string& each : listed(folder)) {
        if (fs::symlink_status(each, unreadable).type() != fs::file_type::directory) continue;
        const std::vector<std::string> more = depth < kDeepest ? filesIn(each, depth + 1) : std::vector<std::string>();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

/// Whether a file may be a scan. Text must contain points: many folders of scans have a text about them.
bool mayBeScan(const std::string& path) {
    if (suffixKind(path) == SuffixOf::kScan) return true;
    try {
        readPrologue(openInputFile(path, NamedBy::kFile));
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// A broken link counts as a file, so that opening it reports its name.
bool isFileOrGone(const std::string& path) {
    std::error_code failure;
    const fs::file_type type = fs::status(path, failure).type();
    return type == fs::file_type::regular || type == fs::file_type::not_found;
}

/// The scans of a folder, else its text files.
std::vector<std::string> scansOrTextsIn(const std::string& folder) {
    std::vector<std::string> scans, texts;
    for (const std::string& path : listed(folder)) {
        const SuffixOf kind = suffixKind(path);
        if (kind == SuffixOf::kOther || !isFileOrGone(path)) continue;
        (kind == SuffixOf::kScan ? scans : texts).push_back(path);
    }
    return scans.empty() ? texts : scans;
}

/// The file of a folder that names all of its other files; "" if no file does.
std::string descriptionIn(const fs::path& folder) {
    std::error_code failure;
    for (const std::string_view name : {kSogLevels, kSogMeta, kEptMeta, kPotreeMeta, kColmapBinary, kColmapText}) {
        const fs::path path = folder / name;
        if (!fs::is_regular_file(path, failure)) continue;
        const InputFile input = openInputFile(path.string(), NamedBy::kFile);
        for (const auto is : {isSogLevels, isSogMeta, isEptMeta, isPotreeMeta, isColmap})
            if (is(input.bytes)) return path.string();
    }
    return "";
}

void keepPosed(std::vector<std::string>& scans) {
    const auto is_conf = [](const std::string& name) { return name.ends_with(".conf"); };
    if (std::any_of(scans.begin(), scans.end(), is_conf)) std::erase_if(scans, std::not_fn(is_conf));
}

/// Text files are ignored if none has points and either depth is above 0 or there are scans in subfolders: they are
/// about those scans.
std::vector<std::string> filesIn(const std::string& folder, int depth) {
    if (const std::string description = descriptionIn(folder); !description.empty()) return {description};
    std::vector<std::string> scans = scansOrTextsIn(folder);
    keepPosed(scans);
    if (std::any_of(scans.begin(), scans.end(), mayBeScan)) return scans;
    const std::vector<std::string> below = filesBelow(folder, depth);
    return below.empty() && depth == 0 ? scans : below; // their errors will name file and line
}

} // namespace

std::vector<std::string> filesOf(const std::vector<std::string>& paths) {
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        std::error_code failure;
        if (path == "-" || !fs::is_directory(path, failure)) {
            files.push_back(path);
            continue;
        }
        const std::vector<std::string> scans = filesIn(path, 0);
        if (scans.empty())
            throw Error(ExitCode::kBadInput, path +
                                                 ": neither the folder nor its subfolders have a scan that this build "
                                                 "reads");
        files.insert(files.end(), scans.begin(), scans.end());
    }
    return files;
}

} // namespace pointrt

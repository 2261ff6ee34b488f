// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/folders.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "format/base/error.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/sog_files.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> scansIn(const std::string& folder) {
    std::vector<std::string> scans, texts;
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
        const std::string name = entry->path().filename().string();
        const SuffixOf kind = suffixKind(name);
        if (name.starts_with('.') || kind == SuffixOf::kOther || !entry->is_regular_file(failure)) continue;
        (kind == SuffixOf::kScan ? scans : texts).push_back(entry->path().string());
    }
    if (scans.empty()) scans = texts;
    if (failure) throw Error(ExitCode::kBadInput, folder + ": " + failure.message());
    if (scans.empty()) throw Error(ExitCode::kBadInput, folder + ": the folder has no scan that this build reads");
    std::sort(scans.begin(), scans.end());
    return scans;
}

/// The file of a folder that names all of its other files; "" if no file does.
std::string sogIn(const fs::path& folder) {
    std::error_code failure;
    for (const std::string_view name : {kSogLevels, kSogMeta}) {
        const fs::path path = folder / name;
        if (!fs::is_regular_file(path, failure)) continue;
        const InputFile input = openInputFile(path.string(), NamedBy::kFile);
        if (isSogLevels(input.bytes) || isSogMeta(input.bytes)) return path.string();
    }
    return "";
}

void keepPosed(std::vector<std::string>& scans) {
    const auto is_conf = [](const std::string& name) { return name.ends_with(".conf"); };
    if (std::any_of(scans.begin(), scans.end(), is_conf)) std::erase_if(scans, std::not_fn(is_conf));
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
        if (const std::string sog = sogIn(path); !sog.empty()) {
            files.push_back(sog);
            continue;
        }
        std::vector<std::string> scans = scansIn(path);
        keepPosed(scans);
        files.insert(files.end(), scans.begin(), scans.end());
    }
    return files;
}

} // namespace pointrt

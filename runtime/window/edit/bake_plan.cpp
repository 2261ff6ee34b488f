// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/bake_plan.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "format/base/error.h"
#include "pointrt/pro.hpp"
#include "runtime/window/edit/bake_sources.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBakeTool = "pointrt-bake";

std::vector<std::string> fileNames(const std::vector<std::string>& paths) {
    std::vector<std::string> names;
    for (const std::string& path : paths) names.push_back(fs::path(path).filename().string());
    return names;
}

fs::file_time_type modificationTime(const std::string& path) {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(path, error);
    if (error) throw Error{ExitCode::kBadInput, path + ": " + error.message()};
    if (fs::is_directory(path, error)) throw Error{ExitCode::kBadInput, path + ": is a folder"};
    return time;
}

/// True if path is a complete .pro baked from the current inputs.
bool isUpToDate(const std::vector<std::string>& inputs, fs::file_time_type newest, const std::string& path) {
    try {
        if (modificationTime(path) < newest) return false;
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        return bakeSources(file.metadata()) == fileNames(inputs);
    } catch (const Error&) {
        return false;
    } catch (const ProError&) {
        return false;
    }
}

bool pathExists(const std::string& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

void requireWritable(const std::string& folder) {
    const std::string where = folder.empty() ? "." : folder;
    if (access(where.c_str(), W_OK) != 0)
        throw Error{ExitCode::kCannotWrite, where + ": cannot write a .pro here: " + std::strerror(errno)};
}

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

} // namespace

BakePlan planBake(const std::vector<std::string>& inputs) {
    fs::file_time_type newest = modificationTime(inputs.at(0));
    for (const std::string& input : inputs) newest = std::max(newest, modificationTime(input));
    const fs::path first(inputs.front());
    const std::string stem = (first.parent_path() / first.stem()).string();
    BakePlan plan{inputs, stem + ".pro"};
    for (int number = 1; pathExists(plan.output); ++number) {
        plan.is_up_to_date = isUpToDate(inputs, newest, plan.output);
        if (plan.is_up_to_date) return plan;
        plan.output = stem + "." + std::to_string(number) + ".pro";
    }
    requireWritable(first.parent_path().string());
    return plan;
}

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

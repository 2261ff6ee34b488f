// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/jobs/bake_plan.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "pointrt/pro.hpp"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBaker = "pointrt-bake";

/// As pointrt-bake writes text in a file's metadata.
std::string jsonText(const std::string& text) {
    constexpr const char* kHex = "0123456789abcdef";
    const std::string special = "\"\\\b\f\n\r\t", letters = "\"\\bfnrt";
    std::string quoted(1, '"');
    for (const char c : text) {
        const std::size_t at = special.find(c);
        if (at != std::string::npos)
            quoted += std::string("\\") + letters[at];
        else if (static_cast<unsigned char>(c) < 0x20)
            quoted += std::string("\\u00") + kHex[c >> 4] + kHex[c & 15];
        else
            quoted += c;
    }
    return quoted + '"';
}

/// The part of a .pro's metadata that names the files it was baked from.
std::string sourcesText(const std::vector<std::string>& inputs) {
    std::string list = "\"sources\":";
    char before = '[';
    for (const std::string& input : inputs) {
        list += before;
        list += jsonText(fs::path(input).filename().string());
        before = ',';
    }
    return list + "]";
}

fs::file_time_type changed(const std::string& path) {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(path, error);
    if (error) throw Error{ExitCode::kBadInput, path + ": " + error.message()};
    if (fs::is_directory(path, error)) throw Error{ExitCode::kBadInput, path + ": is a folder"};
    return time;
}

/// A whole .pro of these inputs as they are now.
bool isBakeOf(const std::vector<std::string>& inputs, fs::file_time_type newest, const std::string& path) {
    try {
        if (changed(path) < newest) return false;
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        return file.metadata().find(sourcesText(inputs)) != std::string_view::npos;
    } catch (const Error&) {
        return false;
    }
}

bool isTaken(const std::string& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

void requireWritable(const std::string& folder) {
    const std::string where = folder.empty() ? "." : folder;
    if (access(where.c_str(), W_OK) != 0)
        throw Error{ExitCode::kCannotWrite, where + ": cannot write the .pro there: " + std::strerror(errno)};
}

bool isProgram(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

} // namespace

BakePlan planBake(const std::vector<std::string>& inputs) {
    fs::file_time_type newest = changed(inputs.at(0));
    for (const std::string& input : inputs) newest = std::max(newest, changed(input));
    const fs::path first(inputs.front());
    const std::string stem = (first.parent_path() / first.stem()).string();
    BakePlan plan{inputs, stem + ".pro"};
    for (int number = 1; isTaken(plan.output); ++number) {
        plan.is_there = isBakeOf(inputs, newest, plan.output);
        if (plan.is_there) return plan;
        plan.output = stem + "." + std::to_string(number) + ".pro";
    }
    requireWritable(first.parent_path().string());
    return plan;
}

std::string findBaker(const std::string& folder, const std::string& search_path) {
    const std::string beside = (fs::path(folder) / kBaker).string();
    if (isProgram(beside)) return beside;
    for (std::size_t at = 0; at < search_path.size();) {
        const std::size_t end = std::min(search_path.find(':', at), search_path.size());
        const std::string path = (fs::path(search_path.substr(at, end - at)) / kBaker).string();
        if (end > at && isProgram(path)) return path;
        at = end + 1;
    }
    throw Error{ExitCode::kCannotRun, std::string(kBaker) + " bakes scans, but is neither in " + folder +
                                          " nor in PATH (" + search_path + ")"};
}

std::string findBaker() {
    std::error_code ignored;
    const char* path = std::getenv("PATH");
    return findBaker(fs::read_symlink("/proc/self/exe", ignored).parent_path().string(), path ? path : "");
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/bake_cache.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "format/base/error.h"
#include "format/os/file_lock.h"
#include "pointrt/pro.hpp"
#include "runtime/session/find_tool.h"
#include "runtime/session/tool_run.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// How often a process polls while another one runs the same bake.
constexpr std::chrono::milliseconds kLockPoll{50};

/// Keeps other processes from running the same bake at the same time. Only saves work: without the lock, they would all
/// write the same file.
class BakeLock {
public:
    explicit BakeLock(const std::string& path) { lock_.openFile(path); }
    ~BakeLock() {
        if (locked_) lock_.removeFile();
    }
    BakeLock(const BakeLock&) = delete;
    BakeLock& operator=(const BakeLock&) = delete;

    /// False if another process has the lock.
    bool tryLock() {
        if (!lock_.isOpen()) return true; // the bake will report why nothing can be written
        const format::LockResult result = lock_.take();
        locked_ = result == format::LockResult::kLocked;
        return result != format::LockResult::kTaken;
    }

private:
    format::FileLock lock_;
    bool locked_ = false;
};

bool isComplete(const std::string& path) {
    try {
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        return true;
    } catch (const ProError&) {
        return false;
    }
}

bool isCancelled(const BakeMonitor& monitor) { return monitor.cancelled && monitor.cancelled(); }

/// Waits while another process bakes. False if cancelled.
bool waitFor(BakeLock& lock, const BakeMonitor& monitor) {
    while (!lock.tryLock()) {
        if (isCancelled(monitor)) return false;
        monitor.progress(0, "waiting for another program that bakes the same");
        std::this_thread::sleep_for(kLockPoll);
    }
    return true;
}

/// Parses a line "progress SHARE STAGE RATE" of pointrt-bake --progress lines. False for any other line.
bool parseProgress(const std::string& line, const BakeMonitor& monitor) {
    double share = 0, rate = 0;
    std::array<char, 32> stage{};
    int end = 0;
    const int fields = std::sscanf(line.c_str(), "progress %lf %31s %lf%n", &share, stage.data(), &rate, &end);
    if (fields != 3 || static_cast<std::size_t>(end) != line.size() || !(share >= 0 && share <= 1)) return false;
    std::array<char, 48> text{};
    if (rate >= 1e6)
        std::snprintf(text.data(), text.size(), ", %.1f M points/s", rate / 1e6);
    else if (rate >= 1e3)
        std::snprintf(text.data(), text.size(), ", %.0f k points/s", rate / 1e3);
    monitor.progress(share, std::string(stage.data()) + text.data());
    return true;
}

/// True for notes and warnings, which begin with the tool's name. The last line, which names the output in the cache,
/// does not.
bool isRemark(const std::string& line) {
    const std::string name = std::string(kBakeTool) + ": ";
    return line.starts_with(name) && !line.starts_with(name + "error: ");
}

/// Runs the tool. False if cancelled.
bool runBake(const ScanBake& bake, const std::string& output, const std::string& tool, const BakeMonitor& monitor) {
    std::vector<std::string> arguments{tool, "--progress", "lines", "--force", "-o", output};
    arguments.insert(arguments.end(), bake.options.begin(), bake.options.end());
    arguments.emplace_back("--"); // options may take several values
    for (const std::string& scan : bake.scans) arguments.push_back(safeArgument(scan));
    const ToolResult end = runTool(
        arguments, kBakeTool, [&] { return isCancelled(monitor); },
        [&](const std::string& line) {
            const bool is_progress = parseProgress(line, monitor);
            if (!is_progress && monitor.remark && isRemark(line)) monitor.remark(line);
            return is_progress;
        });
    if (isCancelled(monitor)) return false;
    if (end.wait_status != 0) throw Error{exitCodeOf(end), describeFailure(end, kBakeTool)};
    if (!isComplete(output))
        throw Error{ExitCode::kCannotRun, std::string(kBakeTool) + " succeeded but did not write " + output};
    return true;
}

} // namespace

FileCache userBakeCache() { return userFileCache({"bakes", ".pro", "POINTRT_BAKE_CACHE", kBakeCacheBytes}); }

std::string bakeCached(const FileCache& cache, const ScanBake& bake, const std::string& tool,
                       const BakeMonitor& monitor) {
    if (cache.folder.empty())
        throw Error{ExitCode::kCannotWrite, bake.scans.front() + ": the cache for baked scans is off or has no folder; "
                                                                 "bake the scan with pointrt-bake"};
    monitor.progress(0, "checking");
    const std::string key = bakeKey(bake, tool, [&] { return isCancelled(monitor); });
    if (key.empty()) return {};
    const std::string path = cache.folder + "/" + key + cache.suffix;
    if (!isComplete(path)) {
        makeRoomFor(cache, 0); // creates the folder
        BakeLock lock(cache.folder + "/" + key + ".lock");
        if (!waitFor(lock, monitor)) return {};
        if (!isComplete(path) && !runBake(bake, path, tool, monitor)) return {};
    }
    markUsed(path);
    makeRoomFor(cache, 0, path);
    return path;
}

std::string findBake(const FileCache& cache, const ScanBake& bake, const std::string& tool,
                     const BakeMonitor& monitor) {
    const std::string key = bakeKey(bake, tool, [&] { return isCancelled(monitor); });
    const std::string path = cache.folder + "/" + key + cache.suffix;
    return !key.empty() && isComplete(path) ? path : "";
}

bool isCachedBake(const FileCache& cache, const std::string& path) {
    return !cache.folder.empty() && fs::path(path).parent_path() == fs::path(cache.folder);
}

std::string describeScans(const std::vector<std::string>& scans) {
    const fs::path first = fs::path(scans.at(0)).lexically_normal();
    const std::string name = (first.has_filename() ? first.filename() : first.parent_path().filename()).string();
    return name + (scans.size() > 1 ? " and " + std::to_string(scans.size() - 1) + " more" : "");
}

} // namespace pointrt

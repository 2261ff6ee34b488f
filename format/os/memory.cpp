// SPDX-License-Identifier: Apache-2.0
#include "format/os/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace pointrt {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// The number after name in a file of "NAME NUMBER ..." lines, such as /proc/meminfo.
std::optional<std::uint64_t> numberIn(const std::string& path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        std::uint64_t number = 0;
        if (words >> word >> number && word == name) return number;
    }
    return {};
}

/// The number in a file that holds just one; nullopt for "max".
std::optional<std::uint64_t> numberOf(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return number;
    return {};
}

std::uint64_t above(std::uint64_t whole, std::uint64_t part) { return whole - std::min(whole, part); }

std::uint64_t leftOfMachine() {
    const auto free = numberIn("/proc/meminfo", "MemAvailable:"), swap = numberIn("/proc/meminfo", "SwapFree:");
    return free ? (*free + swap.value_or(0)) * 1024 : kUnlimited;
}

std::uint64_t leftOfAddresses() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
    const auto pages = numberOf("/proc/self/statm"); // the first: mapped pages
    return above(limit.rlim_cur, pages.value_or(0) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

/// File names of control groups, versions 2 and 1.
struct GroupFiles {
    const char *limit, *used, *cached;
};
constexpr GroupFiles kGroupFiles[] = {{"/memory.max", "/memory.current", "file"},
                                      {"/memory.limit_in_bytes", "/memory.usage_in_bytes", "total_cache"}};

std::uint64_t leftOfGroup(const std::string& folder) {
    for (const GroupFiles& files : kGroupFiles) {
        const auto limit = numberOf(folder + files.limit), used = numberOf(folder + files.used);
        if (limit && used)
            return above(*limit, above(*used, numberIn(folder + "/memory.stat", files.cached).value_or(0)));
    }
    return kUnlimited;
}

/// The minimum over the group at path and its ancestors. In containers path may be that on the host: then only the root
/// exists.
std::uint64_t leftOfGroups(const std::string& root, std::string path) {
    std::uint64_t left = leftOfGroup(root);
    while (path.size() > 1) {
        left = std::min(left, leftOfGroup(root + path));
        path.resize(path.rfind('/'));
    }
    return left;
}

/// From the lines "NUMBER:CONTROLLERS:PATH" of /proc/self/cgroup, see cgroups(7).
std::uint64_t leftOfGroups() {
    std::uint64_t left = kUnlimited;
    std::ifstream file("/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
        if (controllers.empty()) left = std::min(left, leftOfGroups("/sys/fs/cgroup", path));
        if (controllers == "memory") left = std::min(left, leftOfGroups("/sys/fs/cgroup/memory", path));
    }
    return left;
}

} // namespace

std::uint64_t peakRssBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

std::uint64_t availableMemory() { return std::min({leftOfMachine(), leftOfAddresses(), leftOfGroups()}); }

} // namespace pointrt

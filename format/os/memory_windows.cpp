// SPDX-License-Identifier: Apache-2.0
#include "format/os/memory.h"

#include "format/os/wide_path_windows.h"

#include <psapi.h>

#include <limits>

namespace pointrt {

std::uint64_t peakRssBytes() {
    PROCESS_MEMORY_COUNTERS counters{};
    GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters.PeakWorkingSetSize;
}

/// Memory that can still be committed: the machine's memory and page files, limited by the process's job.
std::uint64_t availableMemory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    if (GlobalMemoryStatusEx(&status) == 0) return std::numeric_limits<std::uint64_t>::max();
    return status.ullAvailPageFile;
}

} // namespace pointrt

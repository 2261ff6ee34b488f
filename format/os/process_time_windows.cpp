// SPDX-License-Identifier: Apache-2.0
#include "format/os/process_time.h"

#include "format/os/wide_path_windows.h"

#include <cstdint>

namespace pointrt {
namespace {

double seconds(FILETIME time) {
    constexpr double kTick_s = 100e-9;
    return kTick_s * static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime);
}

} // namespace

double secondsSinceStart() {
    FILETIME now{}, start{}, end{}, kernel{}, user{};
    GetSystemTimePreciseAsFileTime(&now);
    GetProcessTimes(GetCurrentProcess(), &start, &end, &kernel, &user);
    return seconds(now) - seconds(start);
}

} // namespace pointrt

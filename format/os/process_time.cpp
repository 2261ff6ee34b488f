// SPDX-License-Identifier: Apache-2.0
#include "format/os/process_time.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace pointrt {
namespace {

double bootSeconds() {
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The start of the process after boot: field 22 of /proc/self/stat in clock ticks (proc(5)). Field 2, in parentheses,
/// may contain spaces.
std::optional<double> startAfterBoot() {
    std::ifstream file("/proc/self/stat");
    std::string line;
    std::getline(file, line);
    const std::size_t name_end = line.rfind(')');
    if (name_end == std::string::npos) return {};
    std::istringstream fields(line.substr(name_end + 1));
    std::string skipped;
    for (int field = 3; field < 22; ++field) fields >> skipped;
    double ticks = 0;
    if (!(fields >> ticks)) return {};
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

} // namespace

double secondsSinceStart() {
    static const double start = startAfterBoot().value_or(bootSeconds());
    return bootSeconds() - start;
}

} // namespace pointrt

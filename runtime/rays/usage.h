// SPDX-License-Identifier: Apache-2.0
// What a command takes of the machine, and how it fails.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "pointrt/trace.hpp"

namespace pointrt {

/// Adds the time that work takes to seconds, and returns what it does.
template <typename Work>
auto timed(double& seconds, const Work& work) {
    using Clock = std::chrono::steady_clock;
    struct Stop {
        double& seconds;
        Clock::time_point start = Clock::now();
        ~Stop() { seconds += std::chrono::duration<double>(Clock::now() - start).count(); }
    } const stop{seconds};
    return work();
}

/// The most memory that the process has held.
std::uint64_t peakRssBytes();

inline ExitCode exitCodeOf(const TraceError& error) { return static_cast<ExitCode>(error.kind); }

/// Calls work and returns what it does; errors of the library become the tools'.
template <typename Work>
auto withToolErrors(const Work& work) {
    try {
        return work();
    } catch (const TraceError& error) {
        throw Error(exitCodeOf(error), error.what());
    }
}

/// A part of the work, and the seconds that it took.
using NamedSeconds = std::pair<std::string, double>;

/// The report of --stats: device, splats, the numbers of counts by their names, millions of rays a second, seconds by
/// part, peak_rss_bytes.
/// @param counts with "rays"
/// @param seconds with "cast", which the rate is told of
std::string reportText(const std::string& device, const std::vector<std::pair<std::string, std::uint64_t>>& counts,
                       const std::vector<NamedSeconds>& seconds);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Timing, the report of --stats, and errors of the library as errors of the tool.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "pointrt/trace.hpp"

namespace pointrt {

/// Calls work, adds its duration to seconds, and returns its result.
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

inline ExitCode exitCodeOf(const TraceError& error) { return static_cast<ExitCode>(error.kind); }

/// Calls work and returns its result. TraceError becomes Error.
template <typename Work>
auto withToolErrors(const Work& work) {
    try {
        return work();
    } catch (const TraceError& error) {
        throw Error(exitCodeOf(error), error.what());
    }
}

/// A part of the work and its seconds.
using NamedSeconds = std::pair<std::string, double>;

/// The JSON report of --stats: device, counts by name, mrays_per_second, seconds by part, peak_rss_bytes.
/// @param counts includes "rays"
/// @param seconds includes "cast", from which the rate is computed
std::string reportText(const std::string& device, const std::vector<std::pair<std::string, std::uint64_t>>& counts,
                       const std::vector<NamedSeconds>& seconds);

} // namespace pointrt

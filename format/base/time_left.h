// SPDX-License-Identifier: Apache-2.0
// Estimates the remaining time of long work.
#pragma once

#include <optional>
#include <string>

namespace pointrt {

/// Extrapolates from the fraction of work done. The estimate counts down like a clock and approaches the newest
/// extrapolation gradually, so that a stage slower than expected does not make it jump.
class TimeLeft {
public:
    /// @param elapsed_s since the start, not decreasing
    /// @param share fraction of the work done, 0 to 1
    /// @return seconds; nullopt until both 2 s and 2 % of the work are done
    std::optional<double> update(double elapsed_s, double share);

private:
    std::optional<double> left_s_;
    double updated_s_ = 0; ///< time of left_s_
};

/// "12 s", "3 min 05 s", "2 h 10 min".
std::string durationText(double seconds);
/// ", 8 s left", at least one second; "" without an estimate
std::string leftText(std::optional<double> seconds);

} // namespace pointrt

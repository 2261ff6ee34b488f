// SPDX-License-Identifier: Apache-2.0
// How long work will still take, for people who wait for it.
#pragma once

#include <optional>
#include <string>

namespace pointrt {

/// Goes by the share of the work that is done. What it says runs down like a clock and is drawn to the newest estimate
/// a little at a time, so that a stage that is slower than was thought does not make it jump.
class TimeLeft {
public:
    /// @param elapsed_s since the work began, never less than before
    /// @param share of the work that is done, 0 to 1
    /// @return seconds; nothing in the first seconds and percents, which tell little
    std::optional<double> update(double elapsed_s, double share);

private:
    std::optional<double> left_s_;
    double asked_s_ = 0; ///< when left_s_ was right
};

/// "12 s", "3 min 05 s", "2 h 10 min".
std::string durationText(double seconds);
/// ", 8 s left", never less than one second; "" where nothing is known
std::string leftText(std::optional<double> seconds);

} // namespace pointrt

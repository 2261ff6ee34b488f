// SPDX-License-Identifier: Apache-2.0
#include "format/base/time_left.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pointrt {

namespace {

// Before this much time and work, a single fast or slow stage would dominate the estimate.
constexpr double kMinElapsed_s = 2, kMinShare = 0.02;
// Time constant: after this time the estimate has covered 1 - 1/e of its difference from the extrapolation.
constexpr double kTimeConstant_s = 4;

} // namespace

std::optional<double> TimeLeft::update(double elapsed_s, double share) {
    if (elapsed_s < kMinElapsed_s || !(share >= kMinShare)) return std::nullopt;
    const double estimate_s = elapsed_s * (1 - std::min(share, 1.0)) / share;
    if (left_s_) {
        const double passed_s = elapsed_s - updated_s_, run_down_s = std::max(0.0, *left_s_ - passed_s);
        left_s_ = run_down_s + (estimate_s - run_down_s) * (1 - std::exp(-passed_s / kTimeConstant_s));
    } else {
        left_s_ = estimate_s;
    }
    updated_s_ = elapsed_s;
    return left_s_;
}

std::string durationText(double seconds) {
    constexpr double most = 359999; // just under 100 h
    const auto whole = static_cast<int>(std::clamp(std::isfinite(seconds) ? std::ceil(seconds) : most, 0.0, most));
    char text[32];
    if (whole < 60)
        std::snprintf(text, sizeof text, "%d s", whole);
    else if (whole < 3600)
        std::snprintf(text, sizeof text, "%d min %02d s", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%d h %02d min", whole / 3600, whole % 3600 / 60);
    return text;
}

std::string leftText(std::optional<double> seconds) {
    return seconds ? ", " + durationText(std::max(1.0, *seconds)) + " left" : "";
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/base/time_left.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pointrt {

namespace {

// Before that a single slow or quick stage decides what is said.
constexpr double kPatience_s = 2, kLeastShare = 0.02;
// In so many seconds what is said makes up two thirds (1 - 1/e) of what it is wrong by.
constexpr double kDraw_s = 4;

} // namespace

std::optional<double> TimeLeft::update(double elapsed_s, double share) {
    if (elapsed_s < kPatience_s || !(share >= kLeastShare)) return std::nullopt;
    const double estimate_s = elapsed_s * (1 - std::min(share, 1.0)) / share;
    if (left_s_) {
        const double passed_s = elapsed_s - asked_s_, run_down_s = std::max(0.0, *left_s_ - passed_s);
        left_s_ = run_down_s + (estimate_s - run_down_s) * (1 - std::exp(-passed_s / kDraw_s));
    } else {
        left_s_ = estimate_s;
    }
    asked_s_ = elapsed_s;
    return left_s_;
}

std::string durationText(double seconds) {
    constexpr double most = 359999; // 99 h and a bit; nobody waits for more
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

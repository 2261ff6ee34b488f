// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/preview_budget.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

constexpr double kLeastRate_hz = 30;
/// Share of a frame's time for tracing: the rest is for the interface, the display, and a reserve.
constexpr double kTracedShare = 0.45;
/// Drivers round refresh rates down: 59.94 Hz becomes 59, which still makes two refreshes per frame at 30 Hz.
constexpr double kRounding = 0.1;
/// Share of the picture that must be traced within one refresh: every other pixel in each direction, from which
/// reprojection makes a sharp picture.
constexpr double kEnough = 0.25;
/// To switch to frames of one refresh, kEnough must fit in this part of the time, so that the rate does not fluctuate.
constexpr double kSpare = 0.75;

} // namespace

double PreviewBudget::next(std::optional<double> display_hz, double picture_s) {
    const double refresh_s = 1 / std::max(display_hz.value_or(2 * kLeastRate_hz), kLeastRate_hz);
    const double budget_s = kTracedShare * refresh_s;
    each_refresh_ = display_hz && kEnough * picture_s <= (each_refresh_ ? 1 : kSpare) * budget_s;
    if (each_refresh_) return budget_s;
    const double refreshes = std::floor(1 / (kLeastRate_hz * refresh_s) + kRounding);
    return std::min(refreshes * budget_s, kTracedShare / kLeastRate_hz);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Moving frames follow the display's rate where the device is fast enough, and are never planned below 30 a second.
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "runtime/window/live/preview_budget.h"

namespace pointrt {
namespace {

constexpr double kSlow_s = std::numeric_limits<double>::infinity(), kFast_s = 0.001;

double budgetOf(std::optional<double> display_hz, double picture_s) {
    return PreviewBudget().next(display_hz, picture_s);
}

TEST(PreviewBudget, WithoutADisplay_Is15ms) {
    EXPECT_DOUBLE_EQ(budgetOf({}, kSlow_s), 0.015);
    EXPECT_DOUBLE_EQ(budgetOf({}, kFast_s), 0.015);
}

TEST(PreviewBudget, OfSlowDevices_IsOfWholeRefreshesAt30HzOrMore) {
    EXPECT_DOUBLE_EQ(budgetOf(60, kSlow_s), 0.015);
    EXPECT_DOUBLE_EQ(budgetOf(59, kSlow_s), 0.015) << "59.94 Hz";
    EXPECT_DOUBLE_EQ(budgetOf(120, kSlow_s), 0.015);
    EXPECT_DOUBLE_EQ(budgetOf(144, kSlow_s), 0.45 * 4 / 144);
    EXPECT_DOUBLE_EQ(budgetOf(75, kSlow_s), 0.45 * 2 / 75);
    EXPECT_DOUBLE_EQ(budgetOf(50, kSlow_s), 0.45 / 50);
    EXPECT_DOUBLE_EQ(budgetOf(24, kSlow_s), 0.015);
}

TEST(PreviewBudget, OfFastDevices_IsOfOneRefresh) {
    for (const double hz : {50.0, 60.0, 144.0, 240.0}) EXPECT_DOUBLE_EQ(budgetOf(hz, kFast_s), 0.45 / hz);
}

TEST(PreviewBudget, DoesNotFlicker) {
    PreviewBudget budget;
    // the time of a picture if a quarter of it fits in a frame
    const double refresh_s = 0.45 / 60, enough_s = 4 * refresh_s;
    EXPECT_DOUBLE_EQ(budget.next(60, 0.9 * enough_s), 0.015);
    EXPECT_DOUBLE_EQ(budget.next(60, 0.7 * enough_s), refresh_s);
    EXPECT_DOUBLE_EQ(budget.next(60, 0.9 * enough_s), refresh_s);
    EXPECT_DOUBLE_EQ(budget.next(60, 1.1 * enough_s), 0.015);
}

} // namespace
} // namespace pointrt

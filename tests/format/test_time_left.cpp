// SPDX-License-Identifier: Apache-2.0
#include "format/base/time_left.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace {

using pointrt::durationText;
using pointrt::leftText;
using pointrt::TimeLeft;

constexpr double kStep_s = 0.1; // between two updates of the display

TEST(TimeLeft, IsUnknownInTheFirstSeconds) {
    TimeLeft left;
    EXPECT_EQ(left.update(0, 0), std::nullopt);
    EXPECT_EQ(left.update(1, 0.5), std::nullopt);
    EXPECT_EQ(left.update(60, 0.001), std::nullopt) << "too little to extrapolate";
    EXPECT_EQ(left.update(70, std::nan("")), std::nullopt);
    EXPECT_TRUE(left.update(80, 0.1));
}

TEST(TimeLeft, IsExactForEvenWork) {
    TimeLeft left;
    for (double t = 0; t <= 100; t += kStep_s) EXPECT_NEAR(left.update(t, t / 100).value_or(100 - t), 100 - t, 1e-6);
}

/// Half of the work is done after 20 of 100 s.
TEST(TimeLeft, ApproachesTheTruthWithoutJumps) {
    TimeLeft left;
    std::optional<double> before;
    for (double t = 0; t <= 100; t += kStep_s) {
        const auto said = left.update(t, t < 20 ? t / 40 : 0.5 + (t - 20) / 160);
        if (before) {
            EXPECT_LT(std::abs(*said - (*before - kStep_s)), 2) << "at " << t;
        }
        before = said;
    }
    EXPECT_NEAR(*before, 0, 1);
}

TEST(TimeLeft, IsNeverNegative) {
    TimeLeft left;
    EXPECT_TRUE(left.update(10, 0.9));
    EXPECT_GE(*left.update(100, 0.9), 0);
    EXPECT_EQ(*TimeLeft().update(10, 1.5), 0);
}

TEST(TimeLeft, FormatsDurations) {
    EXPECT_EQ(durationText(0.2), "1 s");
    EXPECT_EQ(durationText(185), "3 min 05 s");
    EXPECT_EQ(durationText(7800), "2 h 10 min");
    EXPECT_EQ(durationText(1e300), "99 h 59 min");
    EXPECT_EQ(leftText(std::nullopt), "");
    EXPECT_EQ(leftText(0.2), ", 1 s left");
    EXPECT_EQ(leftText(12), ", 12 s left");
}

} // namespace

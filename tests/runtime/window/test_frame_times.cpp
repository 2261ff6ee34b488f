// SPDX-License-Identifier: Apache-2.0
// Frame time statistics.
#include "runtime/window/live/frame_times.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

using namespace std::chrono_literals;

const FrameMeter::Time kStart{};

TEST(FrameMeter, TimesFramesFromInputToDisplay) {
    FrameMeter meter(kStart);
    EXPECT_DOUBLE_EQ(meter.begin(kStart + 20ms), 0.02);
    meter.end(kStart + 30ms, std::nullopt);
    EXPECT_NEAR(meter.meanFrame_ms(), 10, 1e-9);
    EXPECT_TRUE(meter.report.moving_ms.empty()) << "there was no picture";
    EXPECT_DOUBLE_EQ(meter.begin(kStart + 60ms), 0.04) << "from beginning to beginning";
    meter.end(kStart + 100ms, ShownPicture{true, false, 0, 800});
    EXPECT_NEAR(meter.meanFrame_ms(), 11, 1e-9);
    ASSERT_EQ(meter.report.moving_ms.size(), 1u);
    EXPECT_NEAR(meter.report.moving_ms[0], 40, 1e-9);
    EXPECT_EQ(meter.report.moving_pixels, std::vector<double>{800});
    EXPECT_GT(meter.begin(kStart + 60ms), 0) << "no time is no time to fly by";
}

TEST(FrameMeter, SeparatesRefiningFromResting) {
    FrameMeter meter(kStart);
    meter.begin(kStart + 10ms);
    meter.refine(kStart + 25ms);
    meter.refine(kStart + 45ms);
    EXPECT_EQ(meter.frameBegin(), kStart + 10ms);
    meter.end(kStart + 50ms, ShownPicture{false, false, 2, 800});
    ASSERT_EQ(meter.report.resting_ms.size(), 3u);
    EXPECT_NEAR(meter.report.resting_ms[1], 20, 1e-9);
    EXPECT_NEAR(meter.report.resting_ms[2], 5, 1e-9);
    meter.begin(kStart + 60ms);
    meter.end(kStart + 70ms, ShownPicture{false, true, 4, 800});
    EXPECT_EQ(meter.report.resting_ms.size(), 3u) << "nothing was done";
}

TEST(FrameMeter, TimesUntilThePictureIsClean) {
    FrameMeter meter(kStart);
    meter.end(kStart + 10ms, ShownPicture{true, false, 0, 1});
    EXPECT_EQ(meter.report.clean_s, -1);
    meter.end(kStart + 20ms, ShownPicture{false, false, kCleanSamples - 1, 1});
    EXPECT_EQ(meter.report.clean_s, -1);
    meter.end(kStart + 210ms, ShownPicture{false, false, kCleanSamples, 1});
    EXPECT_NEAR(meter.report.clean_s, 0.2, 1e-9);
    meter.end(kStart + 400ms, ShownPicture{false, false, kCleanSamples + 1, 1});
    EXPECT_NEAR(meter.report.clean_s, 0.2, 1e-9) << "the first time counts";
    meter.end(kStart + 500ms, ShownPicture{true, false, 0, 1});
    EXPECT_EQ(meter.report.clean_s, -1) << "until the view changes";
}

} // namespace
} // namespace pointrt

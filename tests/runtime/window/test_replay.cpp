// SPDX-License-Identifier: Apache-2.0
// Replay hands out events by frame, and waits where requested.
#include "runtime/window/input/replay.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

Replay replayOf(const std::string& lines) {
    return Replay(parseRecording("pointrt-recording 1 window 640x480 scale 1\n" + lines, "test"));
}

TEST(Replay, EventsArriveInTheirFrames) {
    Replay replay = replayOf("0 cursor 1 2\n0 wheel 0 1\n2 cursor 3 4\n2 screenshot a\n");
    EXPECT_EQ(replay.next({0, true, false}).events.size(), 2u);
    ReplayFrame frame = replay.next({0, true, false});
    EXPECT_TRUE(frame.events.empty());
    EXPECT_FALSE(frame.quit);
    frame = replay.next({0, true, false});
    EXPECT_EQ(frame.events.size(), 1u);
    EXPECT_EQ(frame.screenshots, std::vector<std::string>{"a"});
    EXPECT_TRUE(frame.quit) << "a recording's end is the window's";
}

TEST(Replay, WaitsForSamples) {
    Replay replay = replayOf("0 cursor 1 2\n0 wait 4\n0 screenshot a\n1 quit\n5 cursor 1 1\n");
    ReplayFrame frame = replay.next({0, true, false});
    EXPECT_EQ(frame.events.size(), 1u);
    EXPECT_TRUE(frame.screenshots.empty());
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(replay.next({3, true, false}).screenshots.empty());
    EXPECT_TRUE(replay.next({9, true, true}).screenshots.empty()) << "while a job is at work";
    frame = replay.next({4, true, false});
    EXPECT_EQ(frame.screenshots.size(), 1u);
    EXPECT_FALSE(frame.quit);
    EXPECT_TRUE(replay.next({4, true, false}).quit);
}

TEST(Replay, DoesNotWaitForever) {
    Replay replay = replayOf("0 wait 300\n0 screenshot a\n");
    replay.next({});
    EXPECT_TRUE(replay.next({256, true, false}).screenshots.empty());
    EXPECT_EQ(replay.next({256, false, false}).screenshots.size(), 1u);
}

TEST(Replay, WaitsForASceneThatIsOpenedAgain) {
    Replay replay = replayOf("0 cursor 1 2\n1 cursor 3 4\n1 wait 4\n1 cursor 5 6\n");
    replay.next({1, true, false});
    replay.waitForPicture();
    EXPECT_TRUE(replay.next({0, true, true}).events.empty());
    EXPECT_EQ(replay.next({1, true, false}).events.size(), 1u);
    replay.waitForPicture();
    EXPECT_TRUE(replay.next({3, true, false}).events.empty()) << "more samples than one are still waited for";
    EXPECT_EQ(replay.next({4, true, false}).events.size(), 1u);
}

TEST(Replay, AnEmptyRecordingQuits) { EXPECT_TRUE(replayOf("").next({0, true, false}).quit); }

} // namespace
} // namespace pointrt

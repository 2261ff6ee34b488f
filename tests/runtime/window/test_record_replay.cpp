// SPDX-License-Identifier: Apache-2.0
// The window's clock, recording and replay.
#include "runtime/window/input/record_replay.h"

#include <gtest/gtest.h>

#include <iterator>

#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

TEST(RecordReplay, ReplayTimeAdvancesPerFrame) {
    const test::TemporaryFolder folder;
    RecordReplay session(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 2\n1 key down H\n2 quit\n"));
    ASSERT_TRUE(session.isReplaying());
    EXPECT_EQ(session.window().width, 64u);
    EXPECT_EQ(session.window().scale, 2);
    EXPECT_EQ(session.now(), 0);
    EXPECT_EQ(session.frameSeconds(5), kReplayFrame_s);
    EXPECT_TRUE(session.next({}).events.empty());
    session.endFrame();
    EXPECT_EQ(session.now(), kReplayFrame_s);
    EXPECT_EQ(session.next({}).events.size(), 1u);
    EXPECT_TRUE(session.next({}).quit);
}

TEST(RecordReplay, RecordsAtTheFrameOfTheClock) {
    const test::TemporaryFolder folder;
    RecordReplay session(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 1\n9 quit\n"));
    session.recordStep(WaitStep{1}); // nothing is being recorded
    session.startRecording(folder.file("out.txt"), {32, 24, 1});
    for (int frame = 0; frame < 3; ++frame) session.endFrame();
    session.recordStep(InputEvent(KeyEvent{keyOf('H'), true}));
    session.endFrame();
    session.recordStep(WaitStep{1});
    std::ifstream written(folder.file("out.txt"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}),
              "pointrt-recording 1 window 32x24 scale 1\n3 key down H\n4 wait 1\n");
}

TEST(RecordReplay, LiveTimeFollowsTheClock) {
    const RecordReplay session("");
    EXPECT_FALSE(session.isReplaying());
    EXPECT_GE(session.now(), 0);
    EXPECT_EQ(session.frameSeconds(5), 5);
}

} // namespace
} // namespace pointrt

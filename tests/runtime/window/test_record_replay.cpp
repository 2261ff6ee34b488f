// SPDX-License-Identifier: Apache-2.0
// The window's clock, and what is recorded by it.
#include "runtime/window/input/record_replay.h"

#include <gtest/gtest.h>

#include <iterator>

#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

TEST(RecordReplay, ReplaysGoByFrames) {
    const test::TemporaryFolder folder;
    RecordReplay tape(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 2\n1 key down H\n2 quit\n"));
    ASSERT_TRUE(tape.isReplaying());
    EXPECT_EQ(tape.window().width, 64u);
    EXPECT_EQ(tape.window().scale, 2);
    EXPECT_EQ(tape.now(), 0);
    EXPECT_EQ(tape.frameSeconds(5), kReplayFrame_s);
    EXPECT_TRUE(tape.next({}).events.empty());
    tape.endFrame();
    EXPECT_EQ(tape.now(), kReplayFrame_s);
    EXPECT_EQ(tape.next({}).events.size(), 1u);
    EXPECT_TRUE(tape.next({}).quit);
}

TEST(RecordReplay, RecordsAtTheFrameOfTheClock) {
    const test::TemporaryFolder folder;
    RecordReplay tape(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 1\n9 quit\n"));
    tape.recordStep(WaitStep{1}); // nobody records
    tape.startRecording(folder.file("out.txt"), {32, 24, 1});
    for (int frame = 0; frame < 3; ++frame) tape.endFrame();
    tape.recordStep(InputEvent(KeyEvent{keyOf('H'), true}));
    tape.endFrame();
    tape.recordStep(WaitStep{1});
    std::ifstream written(folder.file("out.txt"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}),
              "pointrt-recording 1 window 32x24 scale 1\n3 key down H\n4 wait 1\n");
}

TEST(RecordReplay, WithoutAReplayTimePasses) {
    const RecordReplay tape("");
    EXPECT_FALSE(tape.isReplaying());
    EXPECT_GE(tape.now(), 0);
    EXPECT_EQ(tape.frameSeconds(5), 5);
}

} // namespace
} // namespace pointrt

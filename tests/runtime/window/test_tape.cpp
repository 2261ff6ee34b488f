// SPDX-License-Identifier: Apache-2.0
// The window's clock, and what is recorded by it.
#include "runtime/window/input/tape.h"

#include <gtest/gtest.h>

#include <iterator>

#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

TEST(Tape, ReplaysGoByFrames) {
    const test::TemporaryFolder folder;
    Tape tape(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 2\n1 key down H\n2 quit\n"));
    ASSERT_TRUE(tape.replays());
    EXPECT_EQ(tape.window().width, 64u);
    EXPECT_EQ(tape.window().scale, 2);
    EXPECT_EQ(tape.now(), 0);
    EXPECT_EQ(tape.frameSeconds(5), kReplayedFrame_s);
    EXPECT_TRUE(tape.next({}).events.empty());
    tape.endFrame();
    EXPECT_EQ(tape.now(), kReplayedFrame_s);
    EXPECT_EQ(tape.next({}).events.size(), 1u);
    EXPECT_TRUE(tape.next({}).quit);
}

TEST(Tape, RecordsAtTheFrameOfTheClock) {
    const test::TemporaryFolder folder;
    Tape tape(folder.write("in.txt", "pointrt-recording 1 window 64x48 scale 1\n9 quit\n"));
    tape.note(WaitStep{1}); // nobody records
    tape.recordTo(folder.file("out.txt"), {32, 24, 1});
    for (int frame = 0; frame < 3; ++frame) tape.endFrame();
    tape.note(InputEvent(KeyEvent{keyOf('H'), true}));
    tape.endFrame();
    tape.note(WaitStep{1});
    std::ifstream written(folder.file("out.txt"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}),
              "pointrt-recording 1 window 32x24 scale 1\n3 key down H\n4 wait 1\n");
}

TEST(Tape, WithoutAReplayTimePasses) {
    const Tape tape("");
    EXPECT_FALSE(tape.replays());
    EXPECT_GE(tape.now(), 0);
    EXPECT_EQ(tape.frameSeconds(5), 5);
}

} // namespace
} // namespace pointrt

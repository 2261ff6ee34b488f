// SPDX-License-Identifier: Apache-2.0
// Recordings of user input in a window, read and replayed.
#include <cstdlib>

#include "runtime/window/input/recording.h"
#include "runtime/window/input/replay.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

namespace {

/// A recording written and read again must be the same.
void expectSameOnceWritten(const Recording& recording) {
    std::string text = recordingHeader(recording.window);
    for (const RecordedEvent& event : recording.events) text += recordingLine(event);
    const Recording again = parseRecording(text, "again"); // this name must not occur in an error
    if (again.events.size() != recording.events.size()) std::abort();
}

} // namespace

POINTRT_FUZZ_TARGET(recording) {
    fuzz::expectReadOrRefused("recording", [&] {
        const Recording recording = parseRecording(fuzz::textOf(input), "recording");
        expectSameOnceWritten(recording);
        constexpr int kFrames = 200; // recordings may be days long
        Replay replay(recording);
        for (int i = 0; i < kFrames && !replay.next({1, false, false}).quit; ++i) continue;
    });
}

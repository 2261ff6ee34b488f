// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/tape.h"

namespace pointrt {

Tape::Tape(const std::string& replay) {
    if (!replay.empty()) replay_.emplace(readRecording(replay));
}

double Tape::now() const {
    if (replay_) return frame_ * kReplayedFrame_s;
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

/// Recordings go by the clock: frames of a replay are all as long.
void Tape::note(const RecordedStep& step) {
    if (recorder_) record(*recorder_, {static_cast<std::uint32_t>(now() / kReplayedFrame_s + 0.5), step});
}

} // namespace pointrt

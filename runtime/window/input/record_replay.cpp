// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/record_replay.h"

namespace pointrt {

RecordReplay::RecordReplay(const std::string& replay) {
    if (!replay.empty()) replay_.emplace(readRecording(replay));
}

double RecordReplay::now() const {
    if (replay_) return frame_ * kReplayFrame_s;
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

/// Recordings number frames of kReplayFrame_s each, by the clock.
void RecordReplay::recordStep(const RecordedStep& step) {
    if (recorder_) record(*recorder_, {static_cast<std::uint32_t>(now() / kReplayFrame_s + 0.5), step});
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The window's frames, what is recorded of them and what is replayed into them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "runtime/window/input/recording.h"
#include "runtime/window/input/replay.h"

namespace pointrt {

/// Of replays and recordings, and of what moves by itself.
constexpr double kReplayFrame_s = 1.0 / 30;

class RecordReplay {
public:
    /// replay: path of what is to be replayed; empty: nothing is. Throws Error kBadInput as readRecording does.
    explicit RecordReplay(const std::string& replay);
    /// From now on; throws Error kCannotWrite.
    void startRecording(const std::string& path, const ResizeEvent& window) { recorder_ = openRecording(path, window); }

    bool isReplaying() const { return replay_.has_value(); }
    /// The replay's, at the start.
    const ResizeEvent& window() const { return replay_->window(); }
    /// The replay's next frame.
    ReplayFrame next(const PictureState& picture) { return replay_->next(picture); }

    /// Seconds since the start. Replays go by their frames, so that the same recording does the same on any machine.
    double now() const;
    /// How long a frame counts that took so long.
    double frameSeconds(double passed_s) const { return replay_ ? kReplayFrame_s : passed_s; }
    /// The events of a frame have been handled.
    void endFrame() { ++frame_; }
    void recordStep(const RecordedStep& step);

private:
    using Clock = std::chrono::steady_clock;

    std::optional<Replay> replay_;
    std::optional<RecordingWriter> recorder_;
    std::uint32_t frame_ = 0;
    Clock::time_point start_ = Clock::now();
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The window's clock, and recording and replay of its input.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "runtime/window/input/recording.h"
#include "runtime/window/input/replay.h"

namespace pointrt {

/// Frame time of replays and recordings.
constexpr double kReplayFrame_s = 1.0 / 30;

class RecordReplay {
public:
    /// replay: path of a recording to replay; empty: none. Throws Error kBadInput as readRecording does.
    explicit RecordReplay(const std::string& replay);
    /// Records from now on. Throws Error kCannotWrite.
    void startRecording(const std::string& path, const ResizeEvent& window) { recorder_ = openRecording(path, window); }

    bool isReplaying() const { return replay_.has_value(); }
    /// Initial size of the replayed window.
    const ResizeEvent& window() const { return replay_->window(); }
    /// The replay's next frame.
    ReplayFrame next(const PictureState& picture) { return replay_->next(picture); }
    /// In a replay, waits until a scene that is being reopened is on the screen: earlier input would have no effect.
    void waitForPicture() {
        if (replay_) replay_->waitForPicture();
    }

    /// Seconds since the start. In a replay it advances by kReplayFrame_s per frame, so that a recording gives the same
    /// result on every machine.
    double now() const;
    /// Duration of a frame for animations, in seconds. passed_s: the time that has really passed.
    double frameSeconds(double passed_s) const { return replay_ ? kReplayFrame_s : passed_s; }
    /// Call it after a frame's events have been handled.
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

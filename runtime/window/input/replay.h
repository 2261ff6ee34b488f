// SPDX-License-Identifier: Apache-2.0
// Replays a recording frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/window/input/recording.h"

namespace pointrt {

/// Events and requests of a frame.
struct ReplayFrame {
    std::vector<InputEvent> events;
    std::vector<std::string> screenshots; ///< to take of this frame, with the user interface
    bool quit = false;
};

/// The state of the window's picture that a recording can wait for.
struct PictureState {
    std::uint32_t samples = 0; ///< per pixel
    bool grows = false;        ///< more samples follow
    bool busy = false;         ///< a job is running, or the picture is not shown yet
};

class Replay {
public:
    explicit Replay(Recording recording) : recording_(std::move(recording)) {}

    /// Initial size.
    const ResizeEvent& window() const { return recording_.window; }

    /// The next frame. While the recording waits for samples or for a job, frames are empty and not counted. Sets quit
    /// after the last event.
    ReplayFrame next(const PictureState& picture);
    /// Waits for one sample, like a WaitStep, unless the replay already waits for more.
    void waitForPicture() { wanted_samples_ = wanted_samples_.value_or(1); }

private:
    Recording recording_;
    std::size_t event_ = 0;
    std::uint32_t frame_ = 0;
    std::optional<std::uint32_t> wanted_samples_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A recording as a user: hands out its events frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/window/input/recording.h"

namespace pointrt {

/// What a recording asks for in a frame.
struct ReplayFrame {
    std::vector<InputEvent> events;
    std::vector<std::string> screenshots; ///< to be taken of this frame, with the user interface
    bool quit = false;
};

/// Of the window's picture, for waiting.
struct PictureState {
    std::uint32_t samples = 0; ///< of every pixel
    bool grows = false;        ///< more are to come
    bool busy = false;         ///< a job is at work, or the picture is not shown yet
};

class Replay {
public:
    explicit Replay(Recording recording) : recording_(std::move(recording)) {}

    /// At the start.
    const ResizeEvent& window() const { return recording_.window; }

    /// The next frame's. While the recording waits for samples, and there are more to come, or for a job, frames are
    /// empty and do not count. After the last event the window is to close.
    ReplayFrame next(const PictureState& picture);

private:
    Recording recording_;
    std::size_t event_ = 0;
    std::uint32_t frame_ = 0;
    std::optional<std::uint32_t> wanted_samples_;
};

} // namespace pointrt

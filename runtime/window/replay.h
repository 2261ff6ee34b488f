// SPDX-License-Identifier: Apache-2.0
// A recording as a user: hands out its events frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/window/recording.h"

namespace pointrt {

/// What a recording asks for in a frame.
struct ReplayFrame {
    std::vector<InputEvent> events;
    std::vector<std::string> screenshots; ///< to be taken of this frame, with the user interface
    bool quit = false;
};

class Replay {
public:
    explicit Replay(Recording recording) : recording_(std::move(recording)) {}

    /// At the start.
    const ResizeEvent& window() const { return recording_.window; }

    /// The next frame's. While the recording waits for samples (of every pixel, with the last frame's samples as
    /// they are) or for a job, frames are empty and do not count. After the last event the window is to close.
    ReplayFrame next(std::uint32_t samples, bool busy);

private:
    Recording recording_;
    std::size_t event_ = 0;
    std::uint32_t frame_ = 0;
    std::optional<std::uint32_t> wanted_samples_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/replay.h"

namespace pointrt {

ReplayFrame Replay::next(const PictureState& picture) {
    ReplayFrame frame;
    if (wanted_samples_ && (picture.busy || (picture.grows && picture.samples < *wanted_samples_))) return frame;
    wanted_samples_.reset();
    const std::vector<RecordedEvent>& events = recording_.events;
    for (; event_ < events.size() && events[event_].frame <= frame_; ++event_) {
        const RecordedStep& step = events[event_].step;
        if (const auto* input = std::get_if<InputEvent>(&step)) frame.events.push_back(*input);
        if (const auto* shot = std::get_if<ScreenshotStep>(&step)) frame.screenshots.push_back(shot->name);
        if (std::holds_alternative<QuitStep>(step)) frame.quit = true;
        if (const auto* wait = std::get_if<WaitStep>(&step)) {
            wanted_samples_ = wait->samples;
            ++event_;
            return frame; // all later events wait, even those of the same frame
        }
    }
    ++frame_;
    frame.quit |= event_ == events.size();
    return frame;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// How long the window's frames take, for its report.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// Milliseconds, of at least one value but for all zeros of none.
struct Percentiles {
    std::size_t count = 0;
    double median = 0, p95 = 0, p99 = 0, most = 0;
};

/// By the nearest rank.
Percentiles percentilesOf(std::vector<double> values_ms);

/// What the window tells at its end.
struct WindowReport {
    std::string device;
    std::uint32_t width = 0, height = 0; ///< pixels, at the end
    /// Frames in which the view changed: from the input's arrival to its picture's display.
    std::vector<double> moving_ms;
    std::vector<double> resting_ms;    ///< frames in which the picture got finer
    std::vector<double> moving_pixels; ///< of those pictures
    double first_picture_s = -1;       ///< from the process's start to the first picture of the scene
    double clean_s = -1; ///< from the last change of the view to kCleanSamples samples of every pixel; -1: never
};

/// What counts as a clean picture: the samples that headless runs take.
constexpr std::uint32_t kCleanSamples = 4;

/// A frame's picture, as far as times go.
struct ShownPicture {
    bool moved = false, resting = false; ///< the view changed in this frame; all samples are there
    std::uint32_t samples = 0;           ///< of every pixel
    double pixels = 0;                   ///< that are traced
};

/// Takes the times of the window's frames; they come from the caller.
class FrameMeter {
public:
    using Time = std::chrono::steady_clock::time_point;

    explicit FrameMeter(Time start) : frame_(start), looked_(start), moved_(start) {}
    /// Input was looked for. Returns the seconds since the frame before, above 0.
    double begin(Time now);
    Time frameBegin() const { return frame_; }
    /// The picture got finer, and input is looked for again, within a frame.
    void refine(Time now);
    /// The frame is on the screen; picture: nothing where there is none yet.
    void end(Time now, const std::optional<ShownPicture>& picture);

    double meanFrame_ms() const { return mean_ms_; }
    WindowReport report; ///< device, size and first picture are the caller's to fill in

private:
    Time frame_, looked_, moved_; ///< when the frame began, input was looked for, the view changed
    double mean_ms_ = 0;
};

std::string windowReportJson(const WindowReport& report);

} // namespace pointrt

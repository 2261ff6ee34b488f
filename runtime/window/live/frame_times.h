// SPDX-License-Identifier: Apache-2.0
// Frame times of the window, for its report.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// Milliseconds; all zero if there are no values.
struct Percentiles {
    std::size_t count = 0;
    double median = 0, p95 = 0, p99 = 0, most = 0;
};

/// By the nearest-rank method.
Percentiles percentilesOf(std::vector<double> values_ms);

/// The report that the window writes when it closes.
struct WindowReport {
    std::string device;
    std::uint32_t width = 0, height = 0; ///< pixels, at the end
    /// Frames in which the view changed: from input to display.
    std::vector<double> moving_ms;
    std::vector<double> resting_ms;    ///< frames in which the picture was refined
    std::vector<double> moving_pixels; ///< traced pixels of each frame in moving_ms
    double first_picture_s = -1;       ///< from the start of the process to the first picture
    double clean_s = -1; ///< from the last change of the view to kCleanSamples samples per pixel; -1: never
};

/// Samples of a clean picture: the default of headless runs.
constexpr std::uint32_t kCleanSamples = 4;

/// A frame's picture, for the statistics.
struct ShownPicture {
    bool moved = false, resting = false; ///< moved: the view changed in this frame; resting: all samples are done
    std::uint32_t samples = 0;           ///< per pixel
    double pixels = 0;                   ///< traced
};

/// Measures the window's frames. The caller supplies the times.
class FrameMeter {
public:
    using Time = std::chrono::steady_clock::time_point;

    explicit FrameMeter(Time start) : frame_(start), polled_(start), moved_(start) {}
    /// Input was polled at now. Returns the seconds since the previous frame, above 0.
    double begin(Time now);
    Time frameBegin() const { return frame_; }
    /// The picture was refined and input polled again, within a frame.
    void refine(Time now);
    /// The frame was presented. picture: none before the first one.
    void end(Time now, const std::optional<ShownPicture>& picture);

    double meanFrame_ms() const { return mean_ms_; }
    WindowReport report; ///< the caller fills in device, size and first picture

private:
    Time frame_, polled_, moved_; ///< times of the frame's start, the last poll, and the last change of the view
    double mean_ms_ = 0;
};

std::string windowReportJson(const WindowReport& report);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// How long the window's frames take, for its report.
#pragma once

#include <cstdint>
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

std::string windowReportJson(const WindowReport& report);

} // namespace pointrt

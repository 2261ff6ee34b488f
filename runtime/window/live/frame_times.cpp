// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/frame_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/session/report.h"

namespace pointrt {
namespace {

std::string percentilesJson(const Percentiles& p) {
    char text[200];
    std::snprintf(text, sizeof text, "{\"count\": %zu, \"median\": %.2f, \"p95\": %.2f, \"p99\": %.2f, \"max\": %.2f}",
                  p.count, p.median, p.p95, p.p99, p.most);
    return text;
}

/// Weight of a frame in the displayed mean: averages about the last second at 30 frames per second.
constexpr double kMeanShare = 1.0 / 30;

double secondsBetween(FrameMeter::Time from, FrameMeter::Time to) {
    return std::chrono::duration<double>(to - from).count();
}

std::string secondsJson(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", seconds);
    return seconds < 0 ? "null" : text;
}

} // namespace

Percentiles percentilesOf(std::vector<double> values_ms) {
    if (values_ms.empty()) return {};
    std::sort(values_ms.begin(), values_ms.end());
    const auto at = [&](double share) {
        const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values_ms.size())));
        return values_ms[std::max<std::size_t>(rank, 1) - 1];
    };
    return {values_ms.size(), at(0.5), at(0.95), at(0.99), values_ms.back()};
}

double FrameMeter::begin(Time now) {
    const double passed_s = secondsBetween(frame_, now);
    frame_ = polled_ = now;
    return std::max(1e-4, passed_s);
}

void FrameMeter::refine(Time now) {
    report.resting_ms.push_back(1e3 * secondsBetween(polled_, now));
    polled_ = now;
}

void FrameMeter::end(Time now, const std::optional<ShownPicture>& picture) {
    const double ms = 1e3 * secondsBetween(frame_, now);
    mean_ms_ += (mean_ms_ == 0 ? 1 : kMeanShare) * (ms - mean_ms_);
    if (!picture) return;
    if (picture->moved) {
        report.moving_ms.push_back(ms);
        report.moving_pixels.push_back(picture->pixels);
        moved_ = now;
        report.clean_s = -1;
    } else if (!picture->resting) {
        report.resting_ms.push_back(1e3 * secondsBetween(polled_, now));
    }
    if (report.clean_s < 0 && picture->samples >= kCleanSamples) report.clean_s = secondsBetween(moved_, now);
}

std::string windowReportJson(const WindowReport& report) {
    return jsonObject({{"device", jsonText(report.device)},
                       {"width", std::to_string(report.width)},
                       {"height", std::to_string(report.height)},
                       {"moving_frame_ms", percentilesJson(percentilesOf(report.moving_ms))},
                       {"refining_frame_ms", percentilesJson(percentilesOf(report.resting_ms))},
                       {"moving_pixels", percentilesJson(percentilesOf(report.moving_pixels))},
                       {"first_picture_seconds", secondsJson(report.first_picture_s)},
                       {"clean_picture_seconds", secondsJson(report.clean_s)}});
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace pointrt {

namespace {

/// Often enough to look alive, seldom enough to cost nothing.
constexpr std::chrono::milliseconds kRedrawInterval{100};

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

} // namespace

Progress::Progress(Verbosity verbosity)
    : verbosity_(verbosity), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), stage_start_(start_),
      drawn_(start_) {}

/// Leaves no half-drawn line before an error message.
Progress::~Progress() {
    if (line_open_) fmt::print(stderr, "\r\033[K");
}

void Progress::begin(const std::string& name, std::uint64_t points) {
    end();
    stage_ = name;
    points_ = points;
    stage_start_ = Clock::now();
}

void Progress::finish() { end(); }

void Progress::update(double share) {
    if (verbosity_ == Verbosity::kQuiet || !terminal_) return;
    const auto now = Clock::now();
    if (now - drawn_ < kRedrawInterval) return;
    drawn_ = now;
    redraw(share, secondsBetween(stage_start_, now));
}

double Progress::totalSeconds() const { return secondsBetween(start_, Clock::now()); }

void Progress::redraw(double share, double elapsed_s) {
    const double rate = elapsed_s > 0 ? share * static_cast<double>(points_) / elapsed_s : 0;
    std::string line = fmt::format("\r\033[K{:<10} {:3.0f}%", stage_, 100 * share);
    if (rate > 0) line += fmt::format("  {:.0f} points/s", rate);
    if (share > 0.01) line += fmt::format("  {:.0f} s left", elapsed_s * (1 - share) / share);
    fmt::print(stderr, "{}", line);
    std::fflush(stderr);
    line_open_ = true;
}

void Progress::end() {
    if (stage_.empty()) return;
    const double elapsed_s = secondsBetween(stage_start_, Clock::now());
    const auto known = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage_; });
    if (known != seconds_.end())
        known->second += elapsed_s;
    else
        seconds_.emplace_back(stage_, elapsed_s);
    const bool show = verbosity_ == Verbosity::kDetailed || (verbosity_ == Verbosity::kNormal && !terminal_);
    if (line_open_) fmt::print(stderr, "\r\033[K");
    line_open_ = false;
    if (show && points_ > 0)
        fmt::print(stderr, "{}: {} points, {:.2f} s\n", stage_, points_, elapsed_s);
    else if (show)
        fmt::print(stderr, "{}: {:.2f} s\n", stage_, elapsed_s);
    stage_.clear();
}

} // namespace pointrt

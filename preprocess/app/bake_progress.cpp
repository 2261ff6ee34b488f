// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/bake_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "format/base/printable.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"

namespace pointrt {

namespace {

/// Frequent enough to look smooth, rare enough to cost nothing.
constexpr std::chrono::milliseconds kRedrawInterval{100};

/// Share of the time of a bake per stage, in percent: a compromise between two measurements on eight scans of 38,000 to
/// 1,500,000 points: the index took 27 % on two busy cores, and 8 % in the earlier measurement.
constexpr StageWeight kWeights[] = {{"read", 7},     {"neighbors", 18}, {"normals", 18}, {"orientation", 5},
                                    {"cleaning", 8}, {"radii", 13},     {"quantize", 3}, {"octree", 6},
                                    {"prune", 10},   {"index", 18},     {"write", 2}};

std::vector<StageWeight> weightsWithout(const std::vector<std::string_view>& skipped) {
    std::vector<StageWeight> weights(std::begin(kWeights), std::end(kWeights));
    std::erase_if(weights, [&](const StageWeight& each) {
        return std::find(skipped.begin(), skipped.end(), each.stage) != skipped.end();
    });
    return weights;
}

/// The fraction of the bake done, from the fraction of one of its stages.
double totalShare(const std::vector<StageWeight>& weights, std::string_view stage, double share) {
    double before = 0, all = 0;
    bool reached = false;
    for (const StageWeight& each : weights) {
        all += each.percent;
        if (!reached) before += each.stage == stage ? each.percent * share : each.percent;
        reached |= each.stage == stage;
    }
    return reached ? before / all : 0;
}

constexpr const char* kWipe = "\r\033[K"; ///< erases the redrawn line

/// Prints to standard error and ignores failures; fmt::print would throw.
template <typename... Values>
void print(fmt::format_string<Values...> text, const Values&... values) {
    std::fputs(fmt::vformat(text, fmt::make_format_args(values...)).c_str(), stderr);
    std::fflush(stderr); // Wine's C library buffers it if it is not a terminal
}

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

} // namespace

BakeProgress::BakeProgress(Verbosity verbosity, ProgressStyle style, const std::vector<std::string_view>& skipped)
    : BakeProgress(verbosity, style, weightsWithout(skipped)) {
    logs_stages_ = false;
}

BakeProgress::BakeProgress(Verbosity verbosity, ProgressStyle style, std::vector<StageWeight> weights)
    : weights_(std::move(weights)), verbosity_(verbosity), terminal_(isTerminal(kStandardError)),
      lines_(style == ProgressStyle::kLines), start_(Clock::now()), stage_start_(start_), drawn_(start_) {}

/// Erases the progress line, for an error message to follow.
BakeProgress::~BakeProgress() {
    if (line_open_) std::fputs(kWipe, stderr);
}

void BakeProgress::begin(const std::string& name, std::uint64_t points) {
    end();
    stage_ = name;
    points_ = points;
    stage_start_ = Clock::now();
    total_share_ = std::max(total_share_, totalShare(weights_, stage_, 0));
    if (lines_) writeLine(0, 0);
}

void BakeProgress::finish() { end(); }

void BakeProgress::note(const std::string& text) {
    if (verbosity_ == Verbosity::kQuiet) return;
    if (line_open_) std::fputs(kWipe, stderr);
    line_open_ = false;
    print("pointrt-bake: {}\n", printable(text, std::string::npos));
}

void BakeProgress::detail(const std::string& text) {
    if (verbosity_ == Verbosity::kDetailed) note(text);
}

void BakeProgress::update(double share) {
    if (!lines_ && (verbosity_ == Verbosity::kQuiet || !terminal_)) return;
    const auto now = Clock::now();
    if (now - drawn_ < kRedrawInterval) return;
    drawn_ = now;
    total_share_ = std::max(total_share_, totalShare(weights_, stage_, share));
    const double elapsed_s = secondsBetween(stage_start_, now);
    if (lines_)
        writeLine(share, elapsed_s);
    else
        redraw(share, elapsed_s);
}

double BakeProgress::totalSeconds() const { return secondsBetween(start_, Clock::now()); }

double BakeProgress::rate(double share, double elapsed_s) const {
    if (elapsed_s < std::chrono::duration<double>(kRedrawInterval).count()) return 0; // too short for a rate
    return share * static_cast<double>(points_) / elapsed_s;
}

void BakeProgress::writeLine(double share, double elapsed_s) {
    print("progress {:.4f} {} {:.0f}\n", total_share_, stage_, rate(share, elapsed_s));
}

void BakeProgress::redraw(double share, double elapsed_s) {
    std::string line = fmt::format("\r\033[Kbaking {:3.0f}%", 100 * total_share_);
    line += leftText(left_.update(totalSeconds(), total_share_));
    line += fmt::format(": {} {:.0f}%", stage_, 100 * share);
    const double points_per_s = rate(share, elapsed_s);
    if (points_per_s > 0) line += fmt::format(", {:.0f} points/s", points_per_s);
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    line_open_ = true;
}

void BakeProgress::end() {
    if (stage_.empty()) return;
    const double elapsed_s = secondsBetween(stage_start_, Clock::now());
    const auto known = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage_; });
    if (known != seconds_.end())
        known->second += elapsed_s;
    else
        seconds_.emplace_back(stage_, elapsed_s);
    const bool show = verbosity_ == Verbosity::kDetailed ||
                      (logs_stages_ && verbosity_ == Verbosity::kNormal && !terminal_ && !lines_);
    if (line_open_) std::fputs(kWipe, stderr);
    line_open_ = false;
    if (show && points_ > 0)
        print("{}: {} points, {:.2f} s\n", stage_, points_, elapsed_s);
    else if (show)
        print("{}: {:.2f} s\n", stage_, elapsed_s);
    stage_.clear();
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/bake_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "format/base/printable.h"

namespace pointrt {

namespace {

/// Often enough to look alive, seldom enough to cost nothing.
constexpr std::chrono::milliseconds kRedrawInterval{100};

/// What a stage takes of a bake, in percent: between means over eight scans of 38,000 to 1,500,000 points on two busy
/// cores, where the index takes 27, and those of an earlier measurement, where it took 8.
constexpr StageWeight kWeights[] = {{"read", 7},     {"neighbors", 18}, {"normals", 18}, {"orientation", 5},
                                    {"cleaning", 8}, {"radii", 13},     {"quantize", 3}, {"octree", 6},
                                    {"prune", 10},   {"index", 18},     {"write", 2}};

std::vector<StageWeight> weightsWithout(const std::vector<std::string_view>& left_out) {
    std::vector<StageWeight> weights(std::begin(kWeights), std::end(kWeights));
    std::erase_if(weights, [&](const StageWeight& each) {
        return std::find(left_out.begin(), left_out.end(), each.stage) != left_out.end();
    });
    return weights;
}

/// Of the whole bake, from the share of one of its stages.
double wholeShare(const std::vector<StageWeight>& weights, std::string_view stage, double share) {
    double before = 0, all = 0;
    bool reached = false;
    for (const StageWeight& each : weights) {
        all += each.percent;
        if (!reached) before += each.stage == stage ? each.percent * share : each.percent;
        reached |= each.stage == stage;
    }
    return reached ? before / all : 0;
}

constexpr const char* kWipe = "\r\033[K"; ///< the line that was redrawn

/// On standard error. Where nobody can read it the work goes on: fmt::print would throw.
template <typename... Values>
void tell(fmt::format_string<Values...> text, const Values&... values) {
    std::fputs(fmt::vformat(text, fmt::make_format_args(values...)).c_str(), stderr);
}

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

} // namespace

BakeProgress::BakeProgress(Verbosity verbosity, ProgressStyle style, const std::vector<std::string_view>& left_out)
    : BakeProgress(verbosity, style, weightsWithout(left_out)) {}

BakeProgress::BakeProgress(Verbosity verbosity, ProgressStyle style, std::vector<StageWeight> weights)
    : weights_(std::move(weights)), verbosity_(verbosity), terminal_(isatty(STDERR_FILENO) == 1),
      lines_(style == ProgressStyle::kLines), start_(Clock::now()), stage_start_(start_), drawn_(start_) {}

/// Leaves no half-drawn line before an error message.
BakeProgress::~BakeProgress() {
    if (line_open_) std::fputs(kWipe, stderr);
}

void BakeProgress::begin(const std::string& name, std::uint64_t points) {
    end();
    stage_ = name;
    points_ = points;
    stage_start_ = Clock::now();
    whole_share_ = std::max(whole_share_, wholeShare(weights_, stage_, 0));
    if (lines_) writeLine(0, 0);
}

void BakeProgress::finish() { end(); }

void BakeProgress::note(const std::string& text) {
    if (verbosity_ == Verbosity::kQuiet) return;
    if (line_open_) std::fputs(kWipe, stderr);
    line_open_ = false;
    tell("pointrt-bake: {}\n", printable(text, std::string::npos));
}

void BakeProgress::update(double share) {
    if (!lines_ && (verbosity_ == Verbosity::kQuiet || !terminal_)) return;
    const auto now = Clock::now();
    if (now - drawn_ < kRedrawInterval) return;
    drawn_ = now;
    whole_share_ = std::max(whole_share_, wholeShare(weights_, stage_, share));
    const double elapsed_s = secondsBetween(stage_start_, now);
    if (lines_)
        writeLine(share, elapsed_s);
    else
        redraw(share, elapsed_s);
}

double BakeProgress::totalSeconds() const { return secondsBetween(start_, Clock::now()); }

double BakeProgress::rate(double share, double elapsed_s) const {
    if (elapsed_s < std::chrono::duration<double>(kRedrawInterval).count()) return 0; // too short to go by
    return share * static_cast<double>(points_) / elapsed_s;
}

void BakeProgress::writeLine(double share, double elapsed_s) {
    tell("progress {:.4f} {} {:.0f}\n", whole_share_, stage_, rate(share, elapsed_s));
}

void BakeProgress::redraw(double share, double elapsed_s) {
    std::string line = fmt::format("\r\033[Kbaking {:3.0f}%", 100 * whole_share_);
    line += leftText(left_.update(totalSeconds(), whole_share_));
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
    const bool show = verbosity_ == Verbosity::kDetailed || (verbosity_ == Verbosity::kNormal && !terminal_ && !lines_);
    if (line_open_) std::fputs(kWipe, stderr);
    line_open_ = false;
    if (show && points_ > 0)
        tell("{}: {} points, {:.2f} s\n", stage_, points_, elapsed_s);
    else if (show)
        tell("{}: {:.2f} s\n", stage_, elapsed_s);
    stage_.clear();
}

} // namespace pointrt

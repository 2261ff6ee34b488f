// SPDX-License-Identifier: GPL-3.0-or-later
// Progress on standard error. On a terminal: one redrawn line with the fraction of the bake done, the time left and the
// stage. Otherwise: one line per stage of a tile set, which may take hours, and of any bake with -v. For programs:
// lines "progress FRACTION STAGE RATE" with the fraction of the bake, 0 to 1 and never decreasing, and the points per
// second of the stage, 0 if unknown.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "format/base/time_left.h"
#include "preprocess/app/options.h"

namespace pointrt {

struct StageWeight {
    std::string_view stage;
    double percent; ///< of the time of a bake
};

/// Times the stages of a bake and shows progress. Not thread-safe.
class BakeProgress {
public:
    /// @param skipped stages that this bake does not run
    BakeProgress(Verbosity verbosity, ProgressStyle style, const std::vector<std::string_view>& skipped = {});
    /// For work other than a bake. @param weights its stages in order
    BakeProgress(Verbosity verbosity, ProgressStyle style, std::vector<StageWeight> weights);
    ~BakeProgress();

    /// Ends the previous stage and starts name. @param points work of the stage, 0 if not known yet
    void begin(const std::string& name, std::uint64_t points);
    /// @param share fraction of the stage done, 0 to 1
    void update(double share);
    void setPoints(std::uint64_t points) { points_ = points; }
    void finish(); ///< ends the last stage
    /// Prints a line, unless quiet.
    void note(const std::string& text);
    /// Prints a line if details are requested.
    void detail(const std::string& text);

    /// Seconds of each stage so far, in order; stages of the same name are summed.
    const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
    double totalSeconds() const;

private:
    using Clock = std::chrono::steady_clock;
    void end();
    void redraw(double share, double elapsed_s);
    void writeLine(double share, double elapsed_s);
    double rate(double share, double elapsed_s) const;

    const std::vector<StageWeight> weights_; ///< in the order of the stages
    Verbosity verbosity_;
    bool terminal_, lines_;
    bool logs_stages_ = true; ///< one line per stage if there is no terminal
    std::string stage_;
    std::uint64_t points_ = 0;
    Clock::time_point start_, stage_start_, drawn_;
    bool line_open_ = false;
    double total_share_ = 0; ///< of the bake; never decreases
    TimeLeft left_;
    std::vector<std::pair<std::string, double>> seconds_;
};

} // namespace pointrt

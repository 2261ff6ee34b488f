// SPDX-License-Identifier: GPL-3.0-or-later
// Progress on standard error: on a terminal one redrawn line, with the share of the whole bake and the time that is
// left of it, and then its stage; elsewhere one line a stage; for programs that wait for a bake, lines "progress SHARE
// STAGE RATE" with the share of the whole bake, 0 to 1 and never less than before, and the points a second of the
// stage, 0 where not known.
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

/// Times the stages of a bake and shows them. Not thread-safe: callers hand over one call at a time.
class BakeProgress {
public:
    /// @param left_out stages that this bake does not have
    BakeProgress(Verbosity verbosity, ProgressStyle style, const std::vector<std::string_view>& left_out = {});
    /// Of another work: its stages in their order.
    BakeProgress(Verbosity verbosity, ProgressStyle style, std::vector<StageWeight> weights);
    ~BakeProgress();

    /// Ends the stage before and starts name. points is what the rate is counted in, 0 if not known yet.
    void begin(const std::string& name, std::uint64_t points);
    /// Share of the stage done, in [0, 1].
    void update(double share);
    void setPoints(std::uint64_t points) { points_ = points; }
    void finish(); ///< ends the last stage
    /// A line of its own, unless nothing is to be said.
    void note(const std::string& text);

    /// Seconds of each stage so far, in order; a name that comes twice is added up.
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
    std::string stage_;
    std::uint64_t points_ = 0;
    Clock::time_point start_, stage_start_, drawn_;
    bool line_open_ = false;
    double whole_share_ = 0; ///< never less than before
    TimeLeft left_;
    std::vector<std::pair<std::string, double>> seconds_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/frame_schedule.h"

#include <algorithm>
#include <utility>

namespace pointrt {

FrameSchedule::FrameSchedule(FrameJob job, std::vector<FrameBand> bands, FrameGauges gauges)
    : job_(std::move(job)), bands_(std::move(bands)), gauges_(std::move(gauges)), start_(gauges_.seconds()) {
    for (const FrameBand& each : bands_) height_ += each.band.rows;
    for (const FrameBand& each : bands_) state_.mean += each.samples * shareOf(each);
}

const FrameBand* FrameSchedule::next() {
    current_ = nullptr;
    if (const FrameBand* band = firstBelowGoal()) return band;
    checkNoise();
    const bool progressive = job_.interrupted && !job_.band_by_band;
    goal_ = nextCheck(job_.limits, progressive, job_.samples, state_);
    return firstBelowGoal();
}

const FrameBand* FrameSchedule::firstBelowGoal() {
    if (mustEnd()) return nullptr;
    for (FrameBand& each : bands_)
        if (each.samples < goal_) return current_ = &each;
    return nullptr;
}

void FrameSchedule::addRows(std::uint32_t rows) {
    const double share = static_cast<double>(rows) / height_;
    state_.traced += share;
    state_.mean += share;
    rows_done_ += rows;
    if (rows_done_ == current_->band.rows) {
        ++current_->samples;
        rows_done_ = 0;
    }
    reportProgress();
}

bool FrameSchedule::shouldAbort() {
    if (!mustEnd()) return false;
    updateState();
    return true;
}

bool FrameSchedule::mustEnd() const {
    if (job_.interrupted && job_.interrupted()) return true;
    return job_.limits.seconds && gauges_.seconds() - start_ > *job_.limits.seconds + kTimeOverrun_s;
}

void FrameSchedule::setSamples(std::uint32_t samples) {
    job_.samples = samples;
    goal_ = std::min(goal_, samples);
}

std::uint32_t FrameSchedule::samples() const {
    std::uint32_t fewest = bands_.front().samples;
    for (const FrameBand& each : bands_) fewest = std::min(fewest, each.samples);
    return fewest;
}

double FrameSchedule::shareOf(const FrameBand& band) const { return static_cast<double>(band.band.rows) / height_; }

void FrameSchedule::updateState() {
    state_.seconds = gauges_.seconds() - start_;
    state_.samples = samples();
    state_.empty_rows = 0;
    for (const FrameBand& each : bands_)
        if (each.samples == 0) state_.empty_rows += each.band.rows - (&each == current_ ? rows_done_ : 0);
}

void FrameSchedule::checkNoise() {
    updateState();
    if (!job_.limits.noise || !judgesNoise(state_)) return;
    state_.noise = gauges_.noise();
    state_.noise_samples = state_.samples;
}

void FrameSchedule::reportProgress() {
    if (!job_.progress) return;
    state_.seconds = gauges_.seconds() - start_;
    job_.progress(state_, shareDone(job_.limits, job_.samples, state_));
}

std::vector<FrameBand> frameBands(const Film& film, std::uint32_t rows) {
    const auto samplesOf = [&](std::uint32_t row) {
        return static_cast<std::uint32_t>(film.samples[std::size_t{row} * film.width]);
    };
    std::vector<FrameBand> bands;
    for (std::uint32_t row = 0; row < film.height; ++row) {
        const std::uint32_t samples = samplesOf(row);
        if (bands.empty() || bands.back().band.rows == rows || bands.back().samples != samples)
            bands.push_back({{row, 0}, samples});
        ++bands.back().band.rows;
    }
    return bands;
}

std::vector<FrameBand> emptyBands(std::uint32_t height, std::uint32_t rows) {
    std::vector<FrameBand> bands;
    for (std::uint32_t row = 0; row < height; row += rows) bands.push_back({{row, std::min(rows, height - row)}, 0});
    return bands;
}

} // namespace pointrt

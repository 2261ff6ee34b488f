// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/frame_loop.h"

#include <algorithm>

namespace pointrt {
namespace {

class FrameLoop {
public:
    FrameLoop(const FrameJob& job, std::vector<FrameBand> bands, const FrameSteps& steps)
        : job_(job), steps_(steps), bands_(std::move(bands)), began_(steps.seconds()) {
        for (const FrameBand& each : bands_) height_ += each.band.rows;
        for (const FrameBand& each : bands_) state_.mean += each.samples * shareOf(each);
        look();
    }

    FrameState run() {
        for (;;) {
            const bool progressive = job_.interrupted != nullptr;
            const std::uint32_t next = nextLook(job_.limits, progressive, job_.samples, state_);
            if (next <= state_.samples || stopped()) return state_;
            for (FrameBand& each : bands_) refine(each, next);
            look();
        }
    }

private:
    bool stopped() const { return job_.interrupted && job_.interrupted(); }

    double shareOf(const FrameBand& each) const { return static_cast<double>(each.band.rows) / height_; }

    void refine(FrameBand& each, std::uint32_t samples) {
        if (each.samples >= samples || stopped()) return;
        if (&each != open_) steps_.open(each);
        open_ = &each;
        const bool was_new = each.samples == 0;
        do {
            steps_.trace(each);
            ++each.samples;
            state_.traced += shareOf(each);
            state_.mean += shareOf(each);
            tell();
        } while (each.samples < samples && !stopped());
        steps_.store(each, was_new);
    }

    void look() {
        state_.seconds = steps_.seconds() - began_;
        state_.samples = bands_.front().samples;
        for (const FrameBand& each : bands_) state_.samples = std::min(state_.samples, each.samples);
        if (!job_.limits.noise || !judgesNoise(state_)) return;
        state_.noise = steps_.noise();
        state_.noise_samples = state_.samples;
    }

    void tell() {
        if (!job_.progress) return;
        state_.seconds = steps_.seconds() - began_;
        job_.progress(state_, shareDone(job_.limits, job_.samples, state_));
    }

    const FrameJob& job_;
    const FrameSteps& steps_;
    std::vector<FrameBand> bands_;
    const FrameBand* open_ = nullptr;
    FrameState state_;
    double began_;
    std::uint32_t height_ = 0;
};

} // namespace

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

FrameState runFrame(const FrameJob& job, std::vector<FrameBand> bands, const FrameSteps& steps) {
    return FrameLoop(job, std::move(bands), steps).run();
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The order in which the samples of a frame are taken: band after band, each up to the next check of the limits, until
// the frame is done.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/frame_limits.h"

namespace pointrt {

/// Rows that are on the device together, and the samples of each of their pixels.
struct FrameBand {
    Band band;
    std::uint32_t samples = 0;
};

/// Divides the film into bands of at most `rows` rows with equal numbers of samples.
std::vector<FrameBand> frameBands(const Film& film, std::uint32_t rows);
/// Bands of a film of `height` rows without samples.
std::vector<FrameBand> emptyBands(std::uint32_t height, std::uint32_t rows);

struct FrameJob {
    std::uint32_t samples = 1; ///< most samples per pixel
    FrameLimits limits;
    std::function<bool()> interrupted; ///< may be empty; polled between strips; if it returns true, the frame ends
    /// True: complete each band before the next. False: the bands of a frame that may be interrupted take turns, so
    /// that it has samples everywhere; moving their films to the host and back rounds them.
    bool band_by_band = false;
    std::function<void(const FrameState&, double share)> progress; ///< may be empty; called after each strip
    /// May be empty; only for band_by_band jobs without limits. Receives the rows of each band, from the top, as soon
    /// as they are complete, instead of keeping the film. If interrupted, the last rows have fewer samples.
    std::function<void(const Film& rows)> take_rows;
};

/// Measurements that the limits need.
struct FrameGauges {
    std::function<double()> noise;   ///< noise of the film; called only if the job has a noise limit
    std::function<double()> seconds; ///< a clock
};

/// Chooses the band and sample to trace next. Bands are taken in turn, each up to the next check of the limits.
class FrameSchedule {
public:
    /// bands: at least one.
    FrameSchedule(FrameJob job, std::vector<FrameBand> bands, FrameGauges gauges);

    /// The band to trace next; the sample number is band.samples. Null if the frame is done or interrupted; state is
    /// then final.
    const FrameBand* next();
    /// Reports that `rows` more rows of the current band have the sample; the last rows complete it.
    void addRows(std::uint32_t rows);
    /// Whether to abort the current sample because the frame is interrupted or overran its time limit. State is then
    /// final.
    bool shouldAbort();

    /// Changes the number of samples per pixel. The current sample is still completed.
    void setSamples(std::uint32_t samples);
    /// Fewest samples of any pixel.
    std::uint32_t samples() const;
    /// Progress as of the last check or sample.
    const FrameState& state() const { return state_; }

private:
    const FrameBand* firstBelowGoal();
    double shareOf(const FrameBand& band) const;
    bool mustEnd() const;
    void updateState();
    void checkNoise();
    void reportProgress();

    FrameJob job_;
    std::vector<FrameBand> bands_;
    FrameGauges gauges_;
    FrameState state_;
    FrameBand* current_ = nullptr;
    std::uint32_t rows_done_ = 0; ///< rows of current_ that have its current sample
    std::uint32_t goal_ = 0;      ///< samples of every band at the next check
    std::uint32_t height_ = 0;
    double start_;
};

} // namespace pointrt

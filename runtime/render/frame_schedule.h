// SPDX-License-Identifier: Apache-2.0
// The order in which a frame's samples are taken: bands of rows, each up to the next look, until the frame is done.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/frame_limits.h"

namespace pointrt {

/// Rows that are on the device together, and how many samples their pixels have.
struct FrameBand {
    Band band;
    std::uint32_t samples = 0;
};

/// All of film's rows, at most so many in a band, with the samples that the film says: the same within a band.
std::vector<FrameBand> frameBands(const Film& film, std::uint32_t rows);
/// The same of a film of so many rows that has no samples yet.
std::vector<FrameBand> emptyBands(std::uint32_t height, std::uint32_t rows);

struct FrameJob {
    std::uint32_t samples = 1; ///< a pixel in all, the most
    FrameLimits limits;
    std::function<bool()> interrupted; ///< may be empty; asked between strips, where true the frame ends
    /// A band gets all its samples before the next one. Without it those of a frame that may be interrupted take turns,
    /// so that it has something everywhere; what they have been given is rounded when they come back.
    bool band_by_band = false;
    std::function<void(const FrameState&, double share)> progress; ///< may be empty; after each strip
    /// May be empty; for jobs that go band by band, without limits. Gets each band's rows, from the top, as soon as
    /// they have all their samples: the film is not kept then. Of a frame that is interrupted the last ones have fewer.
    std::function<void(const Film& rows)> take_rows;
};

/// What looks are taken with.
struct FrameGauges {
    std::function<double()> noise;   ///< of all that was sampled; asked only where the job has a noise limit
    std::function<double()> seconds; ///< a clock
};

/// Says which sample of which band comes next. Bands are taken one after the other, each up to the next look.
class FrameSchedule {
public:
    /// bands: at least one.
    FrameSchedule(FrameJob job, std::vector<FrameBand> bands, FrameGauges gauges);

    /// The band whose sample number band.samples is to be taken. Null where the frame is done or interrupted; state has
    /// then had its last look.
    const FrameBand* next();
    /// So many rows more of that band have that sample. With the last of them it was taken.
    void took(std::uint32_t rows);
    /// Whether to break the sample under way off: the frame is interrupted, or much later than its time. It has had its
    /// last look then.
    bool breaksOff();

    /// So many samples a pixel in all from here on. The sample under way is still wanted.
    void setSamples(std::uint32_t samples);
    /// The fewest of any pixel.
    std::uint32_t samples() const;
    /// How far the frame has come, as of the last look or sample.
    const FrameState& state() const { return state_; }

private:
    const FrameBand* firstBelowGoal();
    double shareOf(const FrameBand& band) const;
    bool mustEnd() const;
    void note();
    void look();
    void tell();

    FrameJob job_;
    std::vector<FrameBand> bands_;
    FrameGauges gauges_;
    FrameState state_;
    FrameBand* current_ = nullptr;
    std::uint32_t rows_took_ = 0; ///< of current_'s sample under way
    std::uint32_t goal_ = 0;      ///< samples of every band at the next look
    std::uint32_t height_ = 0;
    double began_;
};

} // namespace pointrt

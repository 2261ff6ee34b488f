// SPDX-License-Identifier: Apache-2.0
// The order in which a frame's samples are taken: bands of rows, each up to the next look, until the frame is done.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/film/frame_limits.h"
#include "runtime/image/film.h"
#include "runtime/tracer/film_readout.h"

namespace pointrt {

/// Rows that are rendered together, and how many samples their pixels have.
struct FrameBand {
    Band band;
    std::uint32_t samples = 0;
};

/// All of film's rows, at most so many in a band, with the samples that the film says: the same within a band.
std::vector<FrameBand> frameBands(const Film& film, std::uint32_t rows);

struct FrameJob {
    std::uint32_t samples = 1; ///< a pixel in all, the most
    FrameLimits limits;
    std::function<bool()> interrupted; ///< may be empty; asked after each sample, where true the frame ends
    std::function<void(const FrameState&, double share)> progress; ///< may be empty
};

/// What is done for it. One band is open at a time.
struct FrameSteps {
    std::function<void(const FrameBand&)> open;                ///< makes ready to go on with it
    std::function<void(const FrameBand&)> trace;               ///< takes its sample number band.samples
    std::function<void(const FrameBand&, bool was_new)> store; ///< puts it into the film; it stays open
    std::function<double()> noise;                             ///< of the film
    std::function<double()> seconds;                           ///< a clock
};

/// Renders bands until job is done or interrupted. Says how far it has come; without a noise limit the noise is not
/// looked at.
FrameState runFrame(const FrameJob& job, std::vector<FrameBand> bands, const FrameSteps& steps);

} // namespace pointrt

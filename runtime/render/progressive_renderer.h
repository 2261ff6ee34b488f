// SPDX-License-Identifier: Apache-2.0
// Progressive rendering of a film, sample by sample: the renderer behind files, turntables, benchmarks and the window.
// It is driven in steps of one submission each, or to the end in one call.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/render/band_tracer.h"
#include "runtime/render/frame_schedule.h"
#include "runtime/render/frame_tiling.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// What to render, and how to take its samples.
struct RenderPlan {
    RenderSettings settings; ///< first_hits, light_parts: parts of the film; spp: 1 for rays through pixel centres
    Camera camera;
    FrameTiling tiling;
    bool preview = false; ///< rays through pixel centres, hard shadows of the first light only: no noise
};

/// Rows of a band that are traced together, one sample per pixel.
struct Strip {
    std::uint32_t first_row = 0; ///< of the band
    BandSample sample;
};

/// The work and time of a complete strip.
struct StripTime {
    std::uint64_t pixels = 0;
    double seconds = 0;      ///< of the device if strips overlap; else by the host's clock
    bool is_preview = false; ///< of the plan
    bool has_first_hits = false;
};

class ProgressiveRenderer {
public:
    /// tracer must outlive it, have a scene with its tables on the device, and room for the pixels rendered.
    ProgressiveRenderer(Device& device, BandTracer& tracer) : device_(device), tracer_(tracer) {}
    ProgressiveRenderer(const ProgressiveRenderer&) = delete;
    ProgressiveRenderer& operator=(const ProgressiveRenderer&) = delete;

    /// Starts a film, or resumes start, which must have the same scene, settings and camera. Drops the current film.
    /// Extends the tracer's film if it has no room for the job's samples.
    void begin(const RenderPlan& plan, const FrameJob& job, std::optional<Film> start = {});

    /// For frames of one band, between strips: works for some milliseconds on the photons that the next strip needs.
    /// True once they are ready.
    bool preparePhotons();
    /// Starts a strip of at most `rows` rows once its photons are ready. Call only between strips. False if the job is
    /// done, interrupted or late.
    bool openStrip(std::uint32_t rows);
    /// Traces the strip further in one submission: the camera rays, and `bounces` bounces. True once it is complete or,
    /// if strips overlap, will be complete before the next submission starts: then it waits for everything submitted
    /// before the last strip, but not for this one.
    /// @param then records commands to run in the same submission
    /// @param submission kWithNext: the strip may go with the next submission, which must follow soon
    bool traceStrip(std::uint32_t bounces, const std::function<void(VkCommandBuffer)>& then = {},
                    Submission submission = Submission::kNow);
    /// Completes the job, in strips with the plan's number of rows, or fewer if those take long (strip_pace.h) and the
    /// frame may be aborted. The film is then on the host, or was passed to take_rows. If aborted, some rows have one
    /// more sample.
    FrameState run();

    /// Changes the number of samples per pixel. The tracer's film must have room for them (extendFilm).
    void setSamples(std::uint32_t samples) {
        if (schedule_) schedule_->setSamples(samples);
    }

    /// Waits for strips that the device may still be tracing.
    void finish();
    /// Whether the device may still be tracing strips that count as complete.
    bool isAhead() const { return !in_flight_.empty(); }
    /// Times of the strips completed since the last call, except those that the device may still be tracing.
    std::vector<StripTime> takeTimes() { return std::exchange(times_, {}); }
    const std::optional<Strip>& strip() const { return strip_; } ///< the strip in progress
    /// Samples that every pixel has.
    std::uint32_t samples() const { return schedule_ ? schedule_->samples() : 0; }
    /// Number of rows of the open band that have the next sample too, except those of the current strip.
    std::uint32_t rowsDone() const { return rows_done_; }
    /// Whether the film has first hits.
    bool hasFirstHits() const { return plan_.settings.first_hits; }
    /// Rays of the samples completed since the last call.
    RayCounts takeRays();
    /// The film so far, in input units, with first hits and light parts if the plan has them. Can be called again later
    /// if the whole film is on the device.
    Film takeFilm();

private:
    struct StripInFlight {
        PassesInFlight passes;
        StripTime time;
    };

    bool overlaps(std::uint32_t bounces) const;
    void submitStrip(std::uint32_t bounces, const std::function<void(VkCommandBuffer)>& then, Submission submission);
    void finishOldest();
    StripTime timeOf(const BandSample& sample, double seconds) const;
    bool openNextBand();
    bool showPhotonsFor(std::uint32_t sample);
    void store();
    void storeRows(std::uint32_t first, std::uint32_t rows, std::uint32_t samples);

    Device& device_;
    BandTracer& tracer_;
    RenderPlan plan_;
    std::optional<FrameSchedule> schedule_;
    std::function<void(const Film& rows)> take_rows_; ///< of the job
    bool may_abort_ = false;
    const FrameBand* open_ = nullptr; ///< the band whose film is on the device
    bool traces_hits_ = false;        ///< its first hits are on the device too
    bool light_waits_ = false;        ///< its light is not on the host yet
    bool hits_wait_ = false;          ///< its first hits are not on the host yet
    std::uint32_t rows_done_ = 0;
    bool may_overlap_ = false; ///< the job has no time limit, which one more strip would overrun
    std::optional<Strip> strip_;
    double strip_seconds_ = 0;            ///< time of its submissions so far
    std::deque<StripInFlight> in_flight_; ///< oldest first, at most kFramesInFlight
    std::vector<StripTime> times_;
    RayCounts rays_;
    Film film_;                     ///< on the host; width 0 until something is stored
    std::uint32_t film_origin_ = 0; ///< row of the picture where the film starts
};

} // namespace pointrt

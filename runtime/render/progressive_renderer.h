// SPDX-License-Identifier: Apache-2.0
// A film that grows sample by sample: the one renderer behind files, turntables, benchmarks and the window. It is
// driven in steps of one submission each, or to the end at once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "runtime/image/film.h"
#include "runtime/render/band_tracer.h"
#include "runtime/render/frame_schedule.h"
#include "runtime/render/frame_tiling.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// What is rendered, and how its samples are taken.
struct RenderPlan {
    RenderSettings settings; ///< first_hits, light_parts: what its film has; spp: 1 for rays through pixels' centres
    Camera camera;
    FrameTiling tiling;
    bool preview = false; ///< rays through pixels' centres, hard shadows of the first lamp alone: no noise, and soon
};

/// Rows of a band whose rays are under way together, for a sample of each pixel.
struct Strip {
    std::uint32_t first_row = 0; ///< of the band
    BandSample sample;
};

class ProgressiveRenderer {
public:
    /// tracer, whose scene is on the device with its tables, must outlive it, and have room for what is rendered.
    ProgressiveRenderer(Device& device, BandTracer& tracer) : device_(device), tracer_(tracer) {}
    ProgressiveRenderer(const ProgressiveRenderer&) = delete;
    ProgressiveRenderer& operator=(const ProgressiveRenderer&) = delete;

    /// Begins a film, or goes on with start, of the same scene, settings and camera. What there was is given up.
    void begin(const RenderPlan& plan, const FrameJob& job, std::optional<Film> start = {});

    /// Of frames that are one band, where no strip is under way: works for some milliseconds on the photons that the
    /// next one shows. True where they are there.
    bool preparePhotons();
    /// Begins a strip of at most so many rows, as soon as its photons are there. Only where none is under way; false
    /// where the job is done, interrupted or late.
    bool openStrip(std::uint32_t rows);
    /// Traces it on, in one submission: the camera rays, and so many bounces. True where it is done, and gone.
    bool traceStrip(std::uint32_t bounces);
    /// All that is left of the job, in strips of the plan's rows; of fewer where those take long (strip_pace.h) and the
    /// frame may be broken off. The film is the host's then, or was handed on. Broken off, it has one sample more in
    /// some of its rows.
    FrameState run();

    /// So many samples a pixel in all from here on.
    void setSamples(std::uint32_t samples) {
        if (schedule_) schedule_->setSamples(samples);
    }

    const std::optional<Strip>& strip() const { return strip_; } ///< under way
    /// Samples of every pixel. Of the next one the open band has this many rows, those of a strip under way not among
    /// them.
    std::uint32_t samples() const { return schedule_ ? schedule_->samples() : 0; }
    std::uint32_t rowsDone() const { return rows_done_; }
    /// Whether its film has first hits.
    bool hasFirstHits() const { return plan_.settings.first_hits; }
    /// Rays of the samples that were taken since the last call.
    RayCounts takeRays();
    /// The film as it is between two samples, with first hits, in input units, and parts of the light where the plan
    /// wants them. Where all of it is on the device, it may be taken again later.
    Film takeFilm();

private:
    bool openNextBand();
    bool showPhotonsFor(std::uint32_t sample);
    void store();
    void storeRows(std::uint32_t first, std::uint32_t rows, std::uint32_t samples);

    Device& device_;
    BandTracer& tracer_;
    RenderPlan plan_;
    std::optional<FrameSchedule> schedule_;
    std::function<void(const Film& rows)> take_rows_; ///< the job's
    bool may_break_off_ = false;
    const FrameBand* open_ = nullptr; ///< whose film is on the device
    bool traces_hits_ = false;        ///< its first hits are, too
    bool light_waits_ = false;        ///< what is on the device is to be stored
    bool hits_wait_ = false;
    std::uint32_t rows_done_ = 0;
    std::optional<Strip> strip_;
    RayCounts rays_;
    Film film_;                     ///< of the host; of width 0 until something is stored
    std::uint32_t film_origin_ = 0; ///< the picture's row that it begins with
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/progressive_renderer.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/render/film_readout.h"
#include "runtime/render/frame_tiling.h"
#include "runtime/render/strip_pace.h"

namespace pointrt {
namespace {

double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

void ProgressiveRenderer::begin(const RenderPlan& plan, const FrameJob& job, std::optional<Film> start) {
    const bool revisits_bands = job.limits.seconds || job.limits.noise || (job.interrupted && !job.band_by_band);
    if (job.take_rows && (revisits_bands || start))
        throw std::logic_error("frame: take_rows needs bands that are rendered once");
    extendFilm(device_, tracer_, job.samples);
    plan_ = plan;
    take_rows_ = job.take_rows;
    may_abort_ = job.interrupted || job.limits.seconds;
    may_overlap_ = !job.limits.seconds;
    film_.width = 0; // keeps its memory
    const std::uint32_t rows = plan.tiling.band_rows;
    std::vector<FrameBand> bands = start ? frameBands(*start, rows) : emptyBands(plan.settings.height, rows);
    if (start) film_ = std::move(*start);
    strip_.reset();
    rows_done_ = film_origin_ = 0;
    open_ = nullptr;
    traces_hits_ = light_waits_ = hits_wait_ = false;
    const auto noise = [this] {
        store();
        return relativeNoise(film_);
    };
    schedule_.emplace(job, std::move(bands), FrameGauges{noise, steadySeconds});
}

bool ProgressiveRenderer::preparePhotons() { return !schedule_ || showPhotonsFor(schedule_->samples()); }

bool ProgressiveRenderer::showPhotonsFor(std::uint32_t sample) {
    return usePhotonMap(device_, tracer_, sample, std::uint64_t{plan_.settings.width} * plan_.settings.height);
}

bool ProgressiveRenderer::openStrip(std::uint32_t most_rows) {
    if (rows_done_ == 0 ? !openNextBand() : schedule_->shouldAbort()) return false;
    while (!showPhotonsFor(open_->samples))
        if (schedule_->shouldAbort()) return false;
    const RenderSettings& settings = plan_.settings;
    const Band& band = open_->band;
    const std::uint32_t rows = stripRows(rows_done_, most_rows, band.rows);
    BandSample sample = openBand(tracer_, settings, plan_.camera, {band.first_row + rows_done_, rows},
                                 {settings.width * band.rows, settings.width * rows_done_});
    sample.number = open_->samples;
    sample.at_centers = plan_.preview || settings.spp == 1;
    sample.preview = plan_.preview;
    sample.first_hits = traces_hits_ && open_->samples == 0;
    strip_ = Strip{rows_done_, sample};
    strip_seconds_ = 0;
    return true;
}

/// Puts the next band to sample on the device.
bool ProgressiveRenderer::openNextBand() {
    const FrameBand* next = schedule_->next();
    if (!next) return false;
    if (next == open_) return true;
    store();
    if (next->samples > 0) {
        const HostSpan span(tracer_.profile, "film to the device");
        restoreLight(device_, tracer_.buffers, next->band, next->samples, film_);
    }
    open_ = next;
    traces_hits_ = hits_wait_ = next->samples == 0 && plan_.settings.first_hits;
    return true;
}

bool ProgressiveRenderer::traceStrip(std::uint32_t bounces, const std::function<void(VkCommandBuffer)>& then,
                                     Submission submission) {
    if (overlaps(bounces)) {
        submitStrip(bounces, then, submission);
    } else {
        finish();
        const double start = steadySeconds();
        tracePasses(device_, tracer_, strip_->sample, bounces, rays_, then);
        strip_seconds_ += steadySeconds() - start;
        if (!strip_->sample.done) return false;
        times_.push_back(timeOf(strip_->sample, strip_seconds_));
    }
    const std::uint32_t rows = strip_->sample.rows;
    strip_.reset();
    light_waits_ = true;
    rows_done_ = (rows_done_ + rows) % open_->band.rows;
    schedule_->addRows(rows);
    return true;
}

/// Whether the strip can be left to the device while the next one is recorded.
bool ProgressiveRenderer::overlaps(std::uint32_t bounces) const {
    return may_overlap_ && strip_->sample.pass == 0 && canOverlap(tracer_) && endsIn(tracer_, plan_.settings, bounces);
}

void ProgressiveRenderer::submitStrip(std::uint32_t bounces, const std::function<void(VkCommandBuffer)>& then,
                                      Submission submission) {
    // waits for what was submitted before the last strip, such as a presentation
    if (in_flight_.size() == kFramesInFlight) waitFor(device_, in_flight_.back().passes.submission - 1);
    while (in_flight_.size() >= kFramesInFlight) finishOldest();
    in_flight_.push_back(
        {submitPasses(device_, tracer_, strip_->sample, bounces, then, submission), timeOf(strip_->sample, 0)});
}

void ProgressiveRenderer::finishOldest() {
    StripTime time = in_flight_.front().time;
    time.seconds = finishPasses(device_, tracer_, in_flight_.front().passes, rays_);
    in_flight_.pop_front();
    times_.push_back(time);
}

void ProgressiveRenderer::finish() {
    while (!in_flight_.empty()) finishOldest();
}

StripTime ProgressiveRenderer::timeOf(const BandSample& sample, double seconds) const {
    return {std::uint64_t{sample.width} * sample.rows, seconds, plan_.preview, sample.first_hits};
}

FrameState ProgressiveRenderer::run() {
    StripPace pace(splatsPerCell(*tracer_.scene), device_.type);
    const std::uint32_t width = plan_.settings.width, most = plan_.tiling.strip_rows;
    while (openStrip(may_abort_ ? pace.rowsFor(width, most) : most)) {
        while (!traceStrip(plan_.settings.bounces)) {
        }
        for (const StripTime& each : takeTimes()) pace.update(each.pixels, each.seconds);
    }
    finish();
    store();
    return schedule_->state();
}

RayCounts ProgressiveRenderer::takeRays() { return std::exchange(rays_, {}); }

Film ProgressiveRenderer::takeFilm() {
    store();
    if (film_.width == 0) allocateFilm(plan_.settings, film_);
    light_waits_ = open_ && (open_->samples > 0 || rows_done_ > 0);
    hits_wait_ = traces_hits_;
    return std::exchange(film_, {});
}

/// Stores the samples that the open band has gained since the last call in the host's film, or passes the rows to
/// take_rows.
void ProgressiveRenderer::store() {
    if (!light_waits_) return;
    const Band& band = open_->band;
    if (take_rows_) film_origin_ = band.first_row;
    if (film_.width == 0) {
        RenderSettings settings = plan_.settings;
        if (take_rows_) settings.height = band.rows;
        allocateFilm(settings, film_);
    }
    storeRows(0, rows_done_, open_->samples + 1);
    storeRows(rows_done_, band.rows - rows_done_, open_->samples);
    light_waits_ = hits_wait_ = false;
    if (!take_rows_) return;
    take_rows_(film_);
    film_.width = 0;
}

/// Stores rows of the open band that have this many samples.
void ProgressiveRenderer::storeRows(std::uint32_t first, std::uint32_t rows, std::uint32_t samples) {
    if (rows == 0 || samples == 0) return;
    const HostSpan span(tracer_.profile, "film read back");
    const BandRows stored{open_->band, first, rows, film_origin_};
    storeLight(device_, tracer_.buffers, stored, samples, film_);
    if (hits_wait_)
        storeFirstHits(device_, tracer_.buffers, stored, *tracer_.scene, plan_.settings, plan_.camera, film_);
}

} // namespace pointrt

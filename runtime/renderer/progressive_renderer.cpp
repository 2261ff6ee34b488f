// SPDX-License-Identifier: Apache-2.0
#include "runtime/renderer/progressive_renderer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "runtime/renderer/film_readout.h"

namespace pointrt {
namespace {

double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

void ProgressiveRenderer::begin(const RenderPlan& plan, const FrameJob& job, const Film* start) {
    plan_ = plan;
    if (start)
        film_ = *start;
    else
        film_.width = 0; // its memory is used again
    strip_.reset();
    rows_done_ = 0;
    open_ = nullptr;
    traces_hits_ = light_waits_ = hits_wait_ = false;
    const auto noise = [this] {
        store();
        return relativeNoise(film_);
    };
    const std::uint32_t rows = plan.tiling.band_rows;
    schedule_.emplace(job, start ? frameBands(*start, rows) : emptyBands(plan.settings.height, rows),
                      FrameGauges{noise, steadySeconds});
}

bool ProgressiveRenderer::openStrip(std::uint32_t most_rows) {
    if (rows_done_ == 0 && !openNextBand()) return false;
    const RenderSettings& settings = plan_.settings;
    const Band& band = open_->band;
    const std::uint32_t rows = std::min(most_rows, band.rows - rows_done_);
    openBand(device_, tracer_, settings, plan_.camera, {band.first_row + rows_done_, rows},
             {settings.width * band.rows, settings.width * rows_done_});
    BandSample sample{settings.width, rows, open_->samples, plan_.preview || settings.spp == 1};
    sample.preview = plan_.preview;
    sample.first_hits = traces_hits_ && open_->samples == 0;
    strip_ = Strip{rows_done_, sample};
    return true;
}

/// Makes the device ready for the band that is to be sampled next.
bool ProgressiveRenderer::openNextBand() {
    const FrameBand* next = schedule_->next();
    if (!next) return false;
    if (next == open_) return true;
    store();
    if (next->samples > 0) restoreLight(device_, tracer_.buffers, next->band, next->samples, film_);
    open_ = next;
    traces_hits_ = hits_wait_ = next->samples == 0 && plan_.settings.first_hits;
    return true;
}

bool ProgressiveRenderer::traceStrip(std::uint32_t bounces) {
    traceOn(device_, tracer_, strip_->sample, bounces, rays_);
    if (!strip_->sample.done) return false;
    rows_done_ += strip_->sample.rows;
    strip_.reset();
    if (rows_done_ < open_->band.rows) return true;
    rows_done_ = 0;
    light_waits_ = true;
    schedule_->took();
    return true;
}

FrameState ProgressiveRenderer::run() {
    while (openStrip(plan_.tiling.strip_rows))
        while (!traceStrip(plan_.settings.bounces)) {
        }
    store();
    return schedule_->state();
}

RayCounts ProgressiveRenderer::takeRays() { return std::exchange(rays_, {}); }

Film ProgressiveRenderer::takeFilm() {
    store();
    if (film_.width == 0) allocateFilm(plan_.settings, film_);
    light_waits_ = open_ && open_->samples > 0;
    hits_wait_ = traces_hits_;
    return std::exchange(film_, {});
}

/// Puts what was traced of the open band since the last time into the host's film.
void ProgressiveRenderer::store() {
    if (!light_waits_) return;
    if (film_.width == 0) allocateFilm(plan_.settings, film_);
    storeLight(device_, tracer_.buffers, open_->band, open_->samples, film_);
    if (hits_wait_)
        storeFirstHits(device_, tracer_.buffers, open_->band, *tracer_.scene, plan_.settings, plan_.camera, film_);
    light_waits_ = hits_wait_ = false;
}

} // namespace pointrt

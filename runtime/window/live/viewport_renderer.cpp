// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/viewport_renderer.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "runtime/session/settings.h"
#include "runtime/tracer/film_readout.h"
#include "runtime/tracer/frame_params.h"

namespace pointrt {
namespace {

using Seconds = std::chrono::duration<double>;

/// The coarse picture that comes first when things rest is this much smaller: a quarter of the pixels.
constexpr double kCoarseDivisor = 2;
/// So long nothing must move before finer pictures begin: longer than between two turns of a wheel.
constexpr double kRest_s = 0.12;
/// A slice is begun only where this much time is left: handing it to the device costs about a millisecond.
constexpr double kMin_s = 0.002;
/// Of the time left, a slice is planned to take this share, so that a wrong guess is no late frame.
constexpr double kPlanned = 0.8;
double since(std::chrono::steady_clock::time_point start) {
    return Seconds(std::chrono::steady_clock::now() - start).count();
}

/// The largest size of this shape whose film can be bound.
PictureSize withinFilm(PictureSize size, std::uint64_t most_pixels) {
    double divisor = 1;
    PictureSize fitting = size;
    while (std::uint64_t{fitting.width} * fitting.height > most_pixels) fitting = reduced(size, divisor *= 1.1);
    return fitting;
}

} // namespace

ViewportRenderer::ViewportRenderer(Device& device, BandTracer& tracer, double moving_budget_s)
    : device_(device), tracer_(tracer), moving_budget_s_(moving_budget_s) {}

ViewportRenderer::~ViewportRenderer() { destroyDisplayPipeline(device_, display_); }

void ViewportRenderer::fitFilm() {
    const PictureSize wanted{view_.settings.width, view_.settings.height};
    const std::uint64_t most = device_.limits.maxStorageBufferRange / (FILM_LAYERS * sizeof(gpu::vec4));
    full_ = withinFilm(wanted, most);
    view_.settings.width = full_.width;
    view_.settings.height = full_.height;
    const std::uint64_t pixels = std::uint64_t{full_.width} * full_.height;
    if (pixels <= film_pixels_) return;
    destroyDisplayPipeline(device_, display_);
    display_ = {};
    film_pixels_ = 0;
    resizeFilm(device_, tracer_, pixels);
    display_ = createDisplayPipeline(device_, tracer_.buffers, pixels);
    film_pixels_ = pixels;
}

void ViewportRenderer::setView(const Viewport& view, bool moving) {
    view_ = view;
    fitFilm();
    restart(moving);
}

void ViewportRenderer::restart(bool moving) {
    updates_.clear();
    moved_ = Clock::now();
    moving_size_ = moving_pace_.movingSize(moving_budget_s_, full_, moving_size_);
    begin(moving ? Stage::kMoving : Stage::kFine);
}

void ViewportRenderer::setLook(const Look& look, bool denoise) {
    view_.look = look;
    view_.denoise = denoise;
    if (full_.width == 0) return;
    const bool lacks_hits = samples_ > 0 && !has_guides_ && hasHits();
    if (lacks_hits) return restart(false);
    const bool filtered = denoise && look.shown == SHOWN_BEAUTY && samples_ < kCleanSamplesOfLight;
    if (filtered && denoised_samples_ > 0)
        showDenoised();
    else
        showFilm();
    denoise_due_ = filtered && stage_ != Stage::kDenoising && denoised_samples_ != samples_;
    if (stage_ == Stage::kResting && denoisesNow()) begin(Stage::kDenoising);
}

void ViewportRenderer::setSamples(std::uint32_t spp) {
    const std::uint32_t before = std::exchange(view_.settings.spp, spp);
    if (before == spp) return;
    // a single sample is one through the pixel's centre
    if (before == 1 || spp == 1) return restart(false);
    if (stage_ == Stage::kResting && samples_ < spp) stage_ = Stage::kFine;
}

/// All rows that have samples, but those under way.
void ViewportRenderer::showFilm() {
    const std::uint32_t under_way = sample_ ? sample_->rows : 0;
    if (row_ > 0) showRows(0, row_, samples_ + 1);
    if (samples_ > 0 && row_ + under_way < size_.height)
        showRows(row_ + under_way, size_.height - row_ - under_way, samples_);
}

void ViewportRenderer::begin(Stage stage) {
    stage_ = stage;
    if (stage == Stage::kDenoising) {
        prepareDenoiser(device_, display_, full_);
        denoise_step_ = 0;
        return;
    }
    if (stage == Stage::kResting) return;
    size_ = stage == Stage::kMoving ? moving_size_ : stage == Stage::kCoarse ? reduced(full_, kCoarseDivisor) : full_;
    sample_.reset();
    row_ = 0;
    samples_ = 0;
    has_guides_ = denoise_due_ = false;
    denoised_samples_ = 0;
}

/// Where to go from a stage that is done.
void ViewportRenderer::next() {
    if (stage_ == Stage::kMoving) return; // until it rests: work()
    if (stage_ == Stage::kCoarse) return begin(Stage::kFine);
    if (stage_ == Stage::kFine && denoisesNow()) return begin(Stage::kDenoising);
    stage_ = samples_ < view_.settings.spp ? Stage::kFine : Stage::kResting;
}

/// At sample counts that are powers of two: in between the picture hardly changes.
bool ViewportRenderer::denoisesNow() const {
    return view_.denoise && view_.look.shown == SHOWN_BEAUTY && has_guides_ && samples_ >= 2 &&
           samples_ < kCleanSamplesOfLight &&
           (denoise_due_ || std::has_single_bit(samples_) || samples_ == view_.settings.spp);
}

bool ViewportRenderer::work(double seconds) {
    if (full_.width == 0 || film_pixels_ == 0 || stage_ == Stage::kResting) return false;
    const Clock::time_point start = Clock::now();
    if (stage_ == Stage::kMoving && samples_ > 0) {
        if (since(moved_) < kRest_s) return false;
        begin(size_.width < reduced(full_, kCoarseDivisor).width ? Stage::kCoarse : Stage::kFine);
    }
    double left = seconds;
    while (stage_ != Stage::kResting && (left > kMin_s || stage_ == Stage::kMoving)) {
        if (mustShow()) return true;
        advance(left);
        if (stage_ == Stage::kMoving && samples_ > 0) return true;
        left = seconds - since(start);
    }
    return true;
}

bool ViewportRenderer::mustShow() const { return !updates_.empty() && updates_.back().size != size_; }

void ViewportRenderer::advance(double seconds_left) {
    if (stage_ == Stage::kDenoising) return denoiseOn();
    if (!sample_) openSlice(seconds_left);
    const Clock::time_point start = Clock::now();
    const Pace& pace = stage_ == Stage::kFine ? fine_pace_ : moving_pace_;
    // what does not fit in one go is handed over bounce by bounce
    const bool fits = pace.secondsFor(std::uint64_t{sample_->width} * sample_->rows) <= seconds_left;
    const std::uint32_t bounces = std::max(view_.settings.bounces, 1u);
    traceOn(device_, tracer_, *sample_, fits || stage_ == Stage::kMoving ? bounces : sample_->pass == 0 ? 0 : 1, rays_);
    slice_seconds_ += since(start);
    if (sample_->done) finishSlice();
}

void ViewportRenderer::openSlice(double seconds_left) {
    std::uint32_t rows = size_.height - row_;
    if (stage_ != Stage::kMoving) {
        const Pace& pace = stage_ == Stage::kFine ? fine_pace_ : moving_pace_;
        rows = std::min(rows, pace.rowsFor(kPlanned * seconds_left, size_.width));
    }
    rows = std::min(rows, std::max(kSliceLanes / (size_.width + TILE_SIDE) / TILE_SIDE, 1u) * TILE_SIDE);
    RenderSettings settings = view_.settings;
    settings.width = size_.width;
    settings.height = size_.height;
    openBand(device_, tracer_, settings, view_.camera, {row_, rows}, {size_.width * size_.height, size_.width * row_});
    BandSample sample{size_.width, rows, samples_};
    sample.at_centers = stage_ != Stage::kFine || view_.settings.spp == 1;
    sample.preview = stage_ != Stage::kFine;
    sample.first_hits = samples_ == 0 && hasHits();
    sample_ = sample;
    slice_seconds_ = 0;
}

void ViewportRenderer::finishSlice() {
    const std::uint32_t first_row = row_, rows = sample_->rows;
    Pace& pace = stage_ == Stage::kFine ? fine_pace_ : moving_pace_;
    if (!sample_->first_hits) pace.learn(std::uint64_t{size_.width} * rows, slice_seconds_);
    traced_seconds_ += slice_seconds_;
    sample_.reset();
    row_ += rows;
    // where the denoiser is at work, the picture in between is its last one
    if (samples_ == 0 || !view_.denoise || view_.look.shown != SHOWN_BEAUTY || samples_ >= kCleanSamplesOfLight)
        showRows(first_row, rows, samples_ + 1);
    if (row_ < size_.height) return;
    row_ = 0;
    ++samples_;
    has_guides_ = hasHits();
    if (samples_ == kCleanSamplesOfLight && view_.denoise) showFilm(); // from here on as it is
    next();
}

/// Whether the film of this stage gets first hits. The whole picture has them for the denoiser and for files, others
/// only where they are looked at.
bool ViewportRenderer::hasHits() const {
    const bool looked_at = needsFirstHits(view_.look);
    return looked_at || (stage_ == Stage::kFine && (view_.denoise || view_.settings.first_hits));
}

FilmRange ViewportRenderer::rangeOf(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) const {
    return {size_.width * first_row, size_.width * rows, size_.width * size_.height, samples};
}

void ViewportRenderer::showRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) {
    const FilmRange range = rangeOf(first_row, rows, samples);
    const VkCommandBuffer commands = beginCommands(device_);
    recordResolve(commands, display_, range, view_.look, false);
    recordTonemap(commands, display_, range, view_.look, false);
    submitAndWait(device_, commands);
    updates_.push_back({size_, first_row, rows});
}

void ViewportRenderer::denoiseOn() {
    const VkCommandBuffer commands = beginCommands(device_);
    const FilmRange all = rangeOf(0, full_.height, samples_);
    Look light = view_.look;
    light.shown = SHOWN_BEAUTY;
    if (denoise_step_ == 0) recordResolve(commands, display_, all, light, true);
    recordDenoiseStep(commands, *display_.denoiser, denoise_step_++);
    submitAndWait(device_, commands);
    if (denoise_step_ < kDenoiseSteps) return;
    denoised_samples_ = samples_;
    denoise_due_ = false;
    stage_ = samples_ < view_.settings.spp ? Stage::kFine : Stage::kResting;
    if (view_.denoise && view_.look.shown == SHOWN_BEAUTY) return showDenoised();
    showFilm();
}

void ViewportRenderer::showDenoised() {
    const VkCommandBuffer commands = beginCommands(device_);
    recordTonemap(commands, display_, rangeOf(0, full_.height, samples_), view_.look, true);
    submitAndWait(device_, commands);
    updates_.push_back({full_, 0, full_.height});
}

ViewportProgress ViewportRenderer::progress() const {
    ViewportProgress progress;
    progress.size = size_;
    progress.samples = isWhole() ? samples_ : 0;
    progress.share = size_.height > 0 ? static_cast<double>(row_) / size_.height : 0;
    progress.resting = stage_ == Stage::kResting;
    progress.denoising = stage_ == Stage::kDenoising;
    const auto rays = static_cast<double>(rays_.primary + rays_.shadow + rays_.secondary);
    progress.mrays_per_second = traced_seconds_ > 0 ? 1e-6 * rays / traced_seconds_ : 0;
    return progress;
}

/// Quick pictures are of another light, whatever their size.
bool ViewportRenderer::isWhole() const {
    return size_ == full_ && stage_ != Stage::kMoving && stage_ != Stage::kCoarse;
}

bool ViewportRenderer::betweenSamples() const { return samples_ > 0 && isWhole() && row_ == 0 && !sample_; }

std::optional<Pick> ViewportRenderer::pick(std::uint32_t x, std::uint32_t y) {
    if (x >= full_.width || y >= full_.height) return std::nullopt;
    const std::uint32_t first = full_.width * y;
    openBand(device_, tracer_, view_.settings, view_.camera, {y, 1}, {full_.width * full_.height, first});
    BandSample sample{full_.width, 1};
    sample.only_first_hits = true;
    RayCounts rays;
    traceOn(device_, tracer_, sample, 0, rays);
    gpu::vec4 hit[FIRST_HIT_VECTORS];
    downloadBuffer(device_, tracer_.buffers.first_hits, hit, sizeof hit, std::uint64_t{first + x} * sizeof hit);
    if (hit[0].w < 0) return std::nullopt;
    Pick pick;
    pick.splat = std::bit_cast<std::uint32_t>(hit[1].x);
    pick.owner = std::bit_cast<std::uint32_t>(hit[1].y);
    pick.distance = hit[0].w * tracer_.scene->space.scale;
    pick.position = centerRayOrigin(view_.settings, view_.camera, x, y) +
                    pick.distance * centerRayDirection(view_.settings, view_.camera, x, y);
    pick.normal = {hit[0].x, hit[0].y, hit[0].z};
    return pick;
}

Film ViewportRenderer::readFilm() {
    Film film;
    RenderSettings settings = view_.settings;
    settings.first_hits = has_guides_;
    allocateFilm(settings, film);
    const Band all{0, full_.height};
    storeLight(device_, tracer_.buffers, all, samples_, film);
    if (has_guides_) storeFirstHits(device_, tracer_.buffers, all, *tracer_.scene, settings, view_.camera, film);
    return film;
}

std::uint64_t ViewportRenderer::deviceBytes() const {
    return pointrt::deviceBytes(tracer_) + pointrt::deviceBytes(display_);
}

} // namespace pointrt

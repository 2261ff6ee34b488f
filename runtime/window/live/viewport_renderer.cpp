// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/viewport_renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "runtime/session/settings.h"
#include "runtime/window/live/frame_times.h"

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
/// What enlarging a coarse picture takes, which a carried one does not want.
constexpr double kEnlarging_s = 0.002;
/// Where more of a carried picture is new than that, tracing does not keep up: a coarse one tells more, unless that has
/// less than a pixel for each of the film's tiles. Then carried points do, which add up frame by frame.
constexpr double kTooNew = 0.35;
/// From so many samples on nothing of the carried picture is mixed with them: clean ones are shown as they are.
constexpr std::uint32_t kUnmixedSamples = kCleanSamples;
/// Of the picture, what the film's samples make up until then: the first ones are noisy, and the carried picture is
/// not, but they are right.
constexpr float kShareOfSample = 0.4f;

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
    : device_(device), tracer_(tracer), renderer_(device, tracer), moving_budget_s_(moving_budget_s) {}

ViewportRenderer::~ViewportRenderer() { destroyDisplayPipeline(device_, display_); }

void ViewportRenderer::fitFilm() {
    const PictureSize wanted{view_.settings.width, view_.settings.height};
    const std::uint64_t most = device_.limits.maxStorageBufferRange / (FILM_LAYERS * sizeof(gpu::vec4)) - kListedPixels;
    const PictureSize before = full_;
    full_ = withinFilm(wanted, most);
    view_.settings.width = full_.width;
    view_.settings.height = full_.height;
    const std::uint64_t pixels = std::uint64_t{full_.width} * full_.height;
    if (full_ != before) {
        moving_picture_.reset();
        shows_whole_ = false;
    }
    if (pixels <= film_pixels_) return;
    moving_picture_.reset();
    destroyDisplayPipeline(device_, display_);
    display_ = {};
    film_pixels_ = 0;
    resizeFilm(device_, tracer_, pixels + kListedPixels);
    display_ = createDisplayPipeline(device_, tracer_.buffers, pixels);
    film_pixels_ = pixels;
}

void ViewportRenderer::setView(const Viewport& view, bool moving, ViewChange change) {
    if (view.look != view_.look) shows_whole_ = false;
    last_camera_ = view_.camera;
    view_ = view;
    fitFilm();
    if (change == ViewChange::kAll) moving_picture_.reset();
    if (change == ViewChange::kScene && moving_picture_) moving_picture_->noteSceneChange();
    restart(moving);
}

void ViewportRenderer::restart(bool moving) {
    updates_.clear();
    moved_ = Clock::now();
    moving_size_ = moving_pace_.movingSize(moving_budget_s_, full_, moving_size_);
    carried_view_ = false;
    if (moving && carries()) {
        if (stage_ != Stage::kCarried) moving_picture_->takePixels();
        return begin(Stage::kCarried);
    }
    if (moving && mayCarry() && wouldBeTiny()) {
        makeMovingPicture();
        moving_picture_->forget();
        return begin(Stage::kCarried);
    }
    begin(moving ? Stage::kMoving : Stage::kFine);
}

/// Of a coarse picture that fits in a frame's time.
bool ViewportRenderer::wouldBeTiny() const {
    return TILE_PIXELS * std::uint64_t{moving_size_.width} * moving_size_.height <
           std::uint64_t{full_.width} * full_.height;
}

/// Light that takes too long to be traced whole in a frame is carried along.
bool ViewportRenderer::mayCarry() const {
    return view_.look.shown == SHOWN_BEAUTY && showsLight(view_.settings.integrator) &&
           moving_pace_.movingSize(moving_budget_s_, full_, moving_size_) != full_;
}

/// Where the last picture is known, and on the screen.
bool ViewportRenderer::carries() const {
    return mayCarry() && shows_whole_ && moving_picture_ && moving_picture_->isKnownFor(last_camera_);
}

MovingView ViewportRenderer::movingView() const {
    return {view_.settings, view_.camera, view_.look.exposure, view_.focus_x, view_.focus_y};
}

/// The frame's picture, and then finer ones of the same view until it rests.
bool ViewportRenderer::workCarried(double seconds) {
    if (carried_view_ && since(moved_) >= kRest_s) {
        begin(Stage::kFine);
        return work(seconds);
    }
    const MovingFrame frame = moving_picture_->advance(movingView(), seconds + kEnlarging_s);
    carried_pixels_ = frame.traced;
    carried_view_ = true;
    carried_most_ = frame.holes < kTooNew * full_.width * full_.height;
    shows_whole_ = carried_most_ || wouldBeTiny();
    updates_.push_back({full_, 0, full_.height});
    return true;
}

void ViewportRenderer::setLook(const Look& look, bool denoise) {
    if (look != view_.look) carried_view_ = shows_whole_ = false; // those colours are another look's
    view_.look = look;
    view_.denoise = denoise;
    if (full_.width == 0) return;
    const std::uint32_t samples = renderer_.samples();
    if (needsHits() && !renderer_.hasFirstHits()) return samples > 0 ? restart(false) : begin(stage_);
    const bool filtered = denoise && look.shown == SHOWN_BEAUTY && samples < kCleanSamplesOfLight;
    if (filtered && denoised_samples_ > 0)
        showDenoised();
    else
        showFilm();
    denoise_due_ = filtered && stage_ != Stage::kDenoising && denoised_samples_ != samples;
    if (stage_ == Stage::kResting && denoisesNow()) begin(Stage::kDenoising);
}

void ViewportRenderer::setSamples(std::uint32_t spp) {
    const std::uint32_t before = std::exchange(view_.settings.spp, spp);
    if (before == spp) return;
    // a single sample is one through the pixel's centre
    if (before == 1 || spp == 1) return restart(false);
    if (isWhole()) renderer_.setSamples(spp);
    if (stage_ == Stage::kResting && renderer_.samples() < spp) stage_ = Stage::kFine;
}

/// All rows that have samples, but those under way.
void ViewportRenderer::showFilm() {
    const std::uint32_t done = renderer_.rowsDone(), samples = renderer_.samples();
    const std::uint32_t under_way = renderer_.strip() ? renderer_.strip()->sample.rows : 0;
    if (done > 0) showRows(0, done, samples + 1);
    if (samples > 0 && done + under_way < size_.height)
        showRows(done + under_way, size_.height - done - under_way, samples);
}

void ViewportRenderer::begin(Stage stage) {
    stage_ = stage;
    if (stage == Stage::kDenoising) {
        prepareDenoiser(device_, display_, full_);
        denoise_step_ = 0;
        return;
    }
    if (stage == Stage::kResting || stage == Stage::kSurvey || full_.width == 0) return;
    if (stage == Stage::kMoving || stage == Stage::kCoarse) shows_whole_ = false;
    size_ = stage == Stage::kMoving ? moving_size_ : stage == Stage::kCoarse ? reduced(full_, kCoarseDivisor) : full_;
    denoise_due_ = false;
    denoised_samples_ = 0;
    beginFilm();
}

/// All of it is one band, in the window's film on the device. Quick pictures are of one sample.
void ViewportRenderer::beginFilm() {
    const bool quick = stage_ == Stage::kMoving || stage_ == Stage::kCoarse;
    RenderPlan plan{view_.settings, view_.camera, {size_.height, size_.height}, quick};
    plan.settings.width = size_.width;
    plan.settings.height = size_.height;
    plan.settings.first_hits = needsHits();
    FrameJob job;
    job.samples = stage_ == Stage::kFine ? view_.settings.spp : 1;
    renderer_.begin(plan, job);
}

/// Where to go from a stage that is done.
void ViewportRenderer::next() {
    if (stage_ == Stage::kMoving) return; // until it rests: work()
    if (stage_ == Stage::kCoarse) return begin(Stage::kFine);
    if (stage_ == Stage::kFine && surveyIsDue()) return begin(Stage::kSurvey);
    if (stage_ == Stage::kFine && denoisesNow()) return begin(Stage::kDenoising);
    stage_ = renderer_.samples() < view_.settings.spp ? Stage::kFine : Stage::kResting;
}

/// At sample counts that are powers of two: in between the picture hardly changes.
bool ViewportRenderer::denoisesNow() const {
    const std::uint32_t samples = renderer_.samples();
    return showsDenoised() && renderer_.hasFirstHits() && samples >= 2 && samples < kCleanSamplesOfLight &&
           (denoise_due_ || std::has_single_bit(samples) || samples == view_.settings.spp);
}

bool ViewportRenderer::showsDenoised() const { return view_.denoise && view_.look.shown == SHOWN_BEAUTY; }

bool ViewportRenderer::work(double seconds) {
    if (full_.width == 0 || film_pixels_ == 0 || stage_ == Stage::kResting) return false;
    if (stage_ == Stage::kCarried) return workCarried(seconds);
    const Clock::time_point start = Clock::now();
    if (stage_ == Stage::kMoving && renderer_.samples() > 0) {
        if (since(moved_) < kRest_s) return false;
        begin(size_.width < reduced(full_, kCoarseDivisor).width ? Stage::kCoarse : Stage::kFine);
    }
    double left = seconds;
    while (stage_ != Stage::kResting && (left > kMin_s || stage_ == Stage::kMoving)) {
        if (mustShow()) return true;
        advance(left);
        if (stage_ == Stage::kMoving && renderer_.samples() > 0) return true;
        left = seconds - since(start);
    }
    return true;
}

bool ViewportRenderer::mustShow() const { return !updates_.empty() && updates_.back().size != size_; }

void ViewportRenderer::advance(double seconds_left) {
    if (stage_ == Stage::kDenoising) return denoiseOn();
    if (stage_ == Stage::kSurvey) return survey();
    if (!renderer_.strip()) {
        slice_seconds_ = 0;
        if (!renderer_.preparePhotons()) return;
        if (!renderer_.openStrip(sliceRows(seconds_left))) return next();
    }
    const Clock::time_point start = Clock::now();
    const Strip strip = *renderer_.strip();
    // what does not fit in one go is handed over bounce by bounce
    const bool fits = pace().secondsFor(std::uint64_t{size_.width} * strip.sample.rows) <= seconds_left;
    const std::uint32_t bounces = std::max(view_.settings.bounces, 1u);
    const bool done = renderer_.traceStrip(fits || stage_ == Stage::kMoving ? bounces : strip.sample.pass == 0 ? 0 : 1);
    slice_seconds_ += since(start);
    if (done) finishSlice(strip);
}

/// As soon as there is a picture: what moves then is carried along.
bool ViewportRenderer::surveyIsDue() {
    if (!mayCarry() || renderer_.samples() == 0) return false;
    makeMovingPicture();
    return !moving_picture_->isSurveyed();
}

void ViewportRenderer::makeMovingPicture() {
    if (!moving_picture_)
        moving_picture_.emplace(device_, tracer_, display_.pixels, PixelSize{full_.width, full_.height});
}

void ViewportRenderer::survey() {
    if (!moving_picture_->survey(movingView())) return;
    stage_ = Stage::kFine;
    next();
}

std::uint32_t ViewportRenderer::sliceRows(double seconds_left) const {
    std::uint32_t rows = size_.height;
    if (stage_ != Stage::kMoving) rows = std::min(rows, pace().rowsFor(kPlanned * seconds_left, size_.width));
    return std::min(rows, std::max(kSliceLanes / (size_.width + TILE_SIDE) / TILE_SIDE, 1u) * TILE_SIDE);
}

void ViewportRenderer::finishSlice(const Strip& strip) {
    const std::uint32_t rows = strip.sample.rows, sample = strip.sample.number;
    if (!strip.sample.first_hits) pace().learn(std::uint64_t{size_.width} * rows, slice_seconds_);
    traced_seconds_ += slice_seconds_;
    const RayCounts rays = renderer_.takeRays();
    rays_ += rays.primary + rays.shadow + rays.secondary;
    // where the denoiser is at work, the picture in between is its last one
    if (sample == 0 || !showsDenoised() || sample >= kCleanSamplesOfLight) showRows(strip.first_row, rows, sample + 1);
    if (renderer_.rowsDone() == 0) finishSample();
}

void ViewportRenderer::finishSample() {
    if (renderer_.samples() == kCleanSamplesOfLight && view_.denoise) showFilm(); // from here on as it is
    next();
}

/// Whether the film of this stage needs first hits. The whole picture has them for the denoiser and for files, others
/// only where they are looked at.
bool ViewportRenderer::needsHits() const {
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
    const float share = shareShown(samples);
    if (share < 1) moving_picture_->blendOver(range.first, range.count, share);
    shows_whole_ = shows_whole_ || (isWhole() && view_.look.shown == SHOWN_BEAUTY && first_row + rows == size_.height);
    updates_.push_back({size_, first_row, rows});
}

/// Of rows of so many samples, where the rest is the carried picture: from one to the other nothing jumps.
float ViewportRenderer::shareShown(std::uint32_t samples) const {
    const bool mixes = stage_ == Stage::kFine && carried_view_ && carried_most_ &&
                       samples < std::min(kUnmixedSamples, view_.settings.spp);
    return mixes ? 1 - std::pow(1 - kShareOfSample, static_cast<float>(samples)) : 1;
}

void ViewportRenderer::denoiseOn() {
    const VkCommandBuffer commands = beginCommands(device_);
    const FilmRange all = rangeOf(0, full_.height, renderer_.samples());
    Look light = view_.look;
    light.shown = SHOWN_BEAUTY;
    if (denoise_step_ == 0) recordResolve(commands, display_, all, light, true);
    recordDenoiseStep(commands, *display_.denoiser, denoise_step_++);
    submitAndWait(device_, commands);
    if (denoise_step_ < kDenoiseSteps) return;
    denoised_samples_ = renderer_.samples();
    denoise_due_ = false;
    stage_ = renderer_.samples() < view_.settings.spp ? Stage::kFine : Stage::kResting;
    if (view_.denoise && view_.look.shown == SHOWN_BEAUTY) return showDenoised();
    showFilm();
}

void ViewportRenderer::showDenoised() {
    const VkCommandBuffer commands = beginCommands(device_);
    recordTonemap(commands, display_, rangeOf(0, full_.height, renderer_.samples()), view_.look, true);
    submitAndWait(device_, commands);
    shows_whole_ = true;
    updates_.push_back({full_, 0, full_.height});
}

ViewportProgress ViewportRenderer::progress() const {
    ViewportProgress progress;
    progress.size = size_;
    progress.traced = stage_ == Stage::kCarried ? carried_pixels_ : 0;
    progress.samples = isWhole() ? renderer_.samples() : 0;
    progress.share = size_.height > 0 ? static_cast<double>(renderer_.rowsDone()) / size_.height : 0;
    progress.resting = stage_ == Stage::kResting;
    progress.denoising = stage_ == Stage::kDenoising;
    progress.mrays_per_second = traced_seconds_ > 0 ? 1e-6 * static_cast<double>(rays_) / traced_seconds_ : 0;
    return progress;
}

/// Quick pictures are of another light, whatever their size.
bool ViewportRenderer::isWhole() const {
    return size_ == full_ && stage_ != Stage::kMoving && stage_ != Stage::kCarried && stage_ != Stage::kCoarse;
}

bool ViewportRenderer::betweenSamples() const {
    return renderer_.samples() > 0 && isWhole() && renderer_.rowsDone() == 0 && !renderer_.strip();
}

std::optional<Pick> ViewportRenderer::pick(std::uint32_t x, std::uint32_t y) {
    if (x >= full_.width || y >= full_.height) return std::nullopt;
    return pickPixel(device_, tracer_, view_.settings, view_.camera, x, y);
}

Film ViewportRenderer::readFilm() { return renderer_.takeFilm(); }

std::uint64_t ViewportRenderer::deviceBytes() const {
    return pointrt::deviceBytes(tracer_) + pointrt::deviceBytes(display_) +
           (moving_picture_ ? moving_picture_->bytes() : 0);
}

} // namespace pointrt

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

/// Resolution divisor of the first picture after a movement: a quarter of the pixels.
constexpr double kCoarseDivisor = 2;
/// Time without movement before refinement starts: longer than between two clicks of a mouse wheel.
constexpr double kRest_s = 0.12;
/// Smallest remaining time in which to start another slice: submitting one takes about a millisecond.
constexpr double kMin_s = 0.002;
/// Share of the remaining time to plan a slice for, so that a misprediction does not delay the frame.
constexpr double kPlanned = 0.8;
/// Time to upscale a preview, which a reprojected frame does not need.
constexpr double kUpscale_s = 0.002;
/// Maximum disoccluded share of a reprojected frame. Beyond it, tracing does not keep up, and a coarse preview shows
/// more. But if the preview would have less than one pixel per tile of the film, points are still accumulated from
/// frame to frame.
constexpr double kMaxNewShare = 0.35;
/// With this many samples, the film is clean and shown without blending.
constexpr std::uint32_t kCleanBlendSamples = kCleanSamples;
/// Weight of each sample in the blend from the reprojected picture to the film: the first samples are right but noisy,
/// while the reprojected picture is smooth.
constexpr float kBlendPerSample = 0.4f;

double since(std::chrono::steady_clock::time_point start) {
    return Seconds(std::chrono::steady_clock::now() - start).count();
}

/// The largest size with this aspect ratio whose film fits in a storage buffer.
PixelSize withinFilm(PixelSize size, std::uint64_t most_pixels) {
    double divisor = 1;
    PixelSize fitting = size;
    while (std::uint64_t{fitting.width} * fitting.height > most_pixels) fitting = reduced(size, divisor *= 1.1);
    return fitting;
}

} // namespace

ViewportRenderer::ViewportRenderer(Device& device, BandTracer& tracer, double preview_budget_s)
    : device_(device), tracer_(tracer), renderer_(device, tracer), preview_budget_s_(preview_budget_s) {}

ViewportRenderer::~ViewportRenderer() { destroyDisplayPipeline(device_, display_); }

/// Makes room for the view's pixels and samples. Returns whether the film keeps its contents.
bool ViewportRenderer::fitFilm() {
    const PixelSize requested{view_.settings.width, view_.settings.height};
    const std::uint32_t samples = view_.settings.spp;
    const std::uint64_t most =
        device_.limits.maxStorageBufferRange / (filmLayers(samples) * sizeof(gpu::vec4)) - kMaxListedPixels;
    const PixelSize before = full_;
    full_ = withinFilm(requested, most);
    view_.settings.width = full_.width;
    view_.settings.height = full_.height;
    const std::uint64_t pixels = std::uint64_t{full_.width} * full_.height;
    if (full_ != before) {
        reprojector_.reset();
        shows_full_frame_ = false;
    }
    if (film_pixels_ == 0 && pixels == 0) return true;
    if (pixels <= film_pixels_ && film_pixels_ <= most) {
        if (extendFilm(device_, tracer_, samples)) {
            bindFilm(device_, display_, tracer_.buffers);
            if (reprojector_) reprojector_->bindFilm();
        }
        return full_ == before;
    }
    reprojector_.reset();
    destroyDisplayPipeline(device_, display_);
    display_ = {};
    film_pixels_ = 0;
    resizeFilm(device_, tracer_, {pixels + kMaxListedPixels, samples});
    display_ = createDisplayPipeline(device_, tracer_.buffers, pixels);
    film_pixels_ = pixels;
    return false;
}

void ViewportRenderer::setView(const Viewport& view, bool moving, ViewChange change) {
    if (view.look != view_.look) shows_full_frame_ = false;
    last_camera_ = view_.camera;
    view_ = view;
    fitFilm();
    if (change == ViewChange::kAll || change == ViewChange::kPlacements) reprojector_.reset();
    if (change == ViewChange::kScene && reprojector_) reprojector_->invalidateLighting();
    restart(moving);
}

void ViewportRenderer::restart(bool moving) {
    updates_.clear();
    moved_ = Clock::now();
    preview_size_ = preview_speed_.previewSize(preview_budget_s_, full_, preview_size_);
    reprojection_current_ = false;
    if (moving && canReproject()) {
        if (stage_ != Stage::kReprojection) reprojector_->readBackColors();
        return begin(Stage::kReprojection);
    }
    if (moving && shouldReproject() && previewIsTiny()) {
        makeReprojector();
        reprojector_->clear();
        return begin(Stage::kReprojection);
    }
    begin(moving ? Stage::kInteractive : Stage::kRefine);
}

/// Whether a preview that fits in the frame's time would be too small to be useful.
bool ViewportRenderer::previewIsTiny() const {
    return TILE_PIXELS * std::uint64_t{preview_size_.width} * preview_size_.height <
           std::uint64_t{full_.width} * full_.height;
}

/// Whether to reproject: for shaded views that take too long to trace in full.
bool ViewportRenderer::shouldReproject() const {
    return view_.look.shown == SHOWN_BEAUTY && castsShadowRays(view_.settings.integrator) &&
           preview_speed_.previewSize(preview_budget_s_, full_, preview_size_) != full_;
}

/// Whether the last picture is cached and on the screen.
bool ViewportRenderer::canReproject() const {
    return shouldReproject() && shows_full_frame_ && reprojector_ && reprojector_->isValidFor(last_camera_);
}

ReprojectionView ViewportRenderer::reprojectionView() const {
    return {view_.settings, view_.camera,  view_.look.exposure,
            view_.focus_x,  view_.focus_y, view_.look.compresses_highlights};
}

/// Renders the reprojected frame, and improves it until the view has rested for kRest_s.
bool ViewportRenderer::workReprojection(double seconds) {
    if (reprojection_current_ && since(moved_) >= kRest_s) {
        begin(Stage::kRefine);
        return work(seconds);
    }
    const ReprojectedFrame frame = reprojector_->renderFrame(reprojectionView(), seconds + kUpscale_s);
    reprojected_pixels_ = frame.traced;
    reprojection_current_ = true;
    mostly_reused_ = frame.disocclusions < kMaxNewShare * full_.width * full_.height;
    shows_full_frame_ = mostly_reused_ || previewIsTiny();
    updates_.push_back({full_, 0, full_.height});
    return true;
}

void ViewportRenderer::setLook(const Look& look, bool denoise) {
    if (look != view_.look) reprojection_current_ = shows_full_frame_ = false; // cached colours belong to the old look
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
    if (stage_ == Stage::kIdle && denoisesNow()) begin(Stage::kDenoising);
}

void ViewportRenderer::setSamples(std::uint32_t spp) {
    const std::uint32_t before = std::exchange(view_.settings.spp, spp);
    if (before == spp) return;
    const bool keeps_film = fitFilm();
    // a single sample goes through the pixel's centre
    if (before == 1 || spp == 1 || !keeps_film) return restart(false);
    if (isFullSize()) renderer_.setSamples(spp);
    if (stage_ == Stage::kIdle && renderer_.samples() < spp) stage_ = Stage::kRefine;
}

/// Shows all rows that have samples, except the strip being traced.
void ViewportRenderer::showFilm() {
    const std::uint32_t done = renderer_.rowsDone(), samples = renderer_.samples();
    const std::uint32_t under_way = renderer_.strip() ? renderer_.strip()->sample.rows : 0;
    if (done > 0) showRows(0, done, samples + 1);
    if (samples > 0 && done + under_way < size_.height)
        showRows(done + under_way, size_.height - done - under_way, samples);
}

void ViewportRenderer::begin(Stage stage) {
    // the tracer keeps the counters of frames in flight in a single place
    if (stage == Stage::kReprojection)
        renderer_.finish();
    else if (reprojector_)
        reprojector_->finish();
    stage_ = stage;
    if (stage == Stage::kDenoising) {
        prepareDenoiser(device_, display_, full_);
        denoise_step_ = 0;
        return;
    }
    if (stage == Stage::kIdle || stage == Stage::kFillCache || full_.width == 0) return;
    if (stage == Stage::kInteractive || stage == Stage::kCoarse) shows_full_frame_ = false;
    size_ = stage == Stage::kInteractive ? preview_size_
            : stage == Stage::kCoarse    ? reduced(full_, kCoarseDivisor)
                                         : full_;
    denoise_due_ = false;
    denoised_samples_ = 0;
    beginFilm();
}

/// The frame is a single band, whose film stays on the device. Previews have one sample.
void ViewportRenderer::beginFilm() {
    const bool quick = stage_ == Stage::kInteractive || stage_ == Stage::kCoarse;
    RenderPlan plan{view_.settings, view_.camera, {size_.height, size_.height}, quick};
    plan.settings.width = size_.width;
    plan.settings.height = size_.height;
    plan.settings.first_hits = needsHits();
    FrameJob job;
    job.samples = stage_ == Stage::kRefine ? view_.settings.spp : 1;
    renderer_.begin(plan, job);
}

/// Chooses the stage after a completed one.
void ViewportRenderer::next() {
    if (stage_ == Stage::kInteractive) return; // work() leaves this stage when the view rests
    if (stage_ == Stage::kCoarse) return begin(Stage::kRefine);
    if (stage_ == Stage::kRefine && needsCacheFill()) return begin(Stage::kFillCache);
    if (stage_ == Stage::kRefine && denoisesNow()) return begin(Stage::kDenoising);
    stage_ = renderer_.samples() < view_.settings.spp ? Stage::kRefine : Stage::kIdle;
}

/// Denoises at sample counts that are powers of two: in between the picture hardly changes.
bool ViewportRenderer::denoisesNow() const {
    const std::uint32_t samples = renderer_.samples();
    return showsDenoised() && renderer_.hasFirstHits() && samples >= 2 && samples < kCleanSamplesOfLight &&
           (denoise_due_ || std::has_single_bit(samples) || samples == view_.settings.spp);
}

bool ViewportRenderer::showsDenoised() const { return view_.denoise && view_.look.shown == SHOWN_BEAUTY; }

bool ViewportRenderer::work(double seconds) {
    if (full_.width == 0 || film_pixels_ == 0 || stage_ == Stage::kIdle) return false;
    if (stage_ == Stage::kReprojection) return workReprojection(seconds);
    const Clock::time_point start = Clock::now();
    if (stage_ == Stage::kInteractive && renderer_.samples() > 0) {
        if (since(moved_) < kRest_s) return false;
        begin(size_.width < reduced(full_, kCoarseDivisor).width ? Stage::kCoarse : Stage::kRefine);
    }
    double left = seconds;
    planned_s_ = 0;
    while (stage_ != Stage::kIdle && (left > kMin_s || stage_ == Stage::kInteractive)) {
        if (mustShow()) return true;
        traceSlice(left);
        if (stage_ == Stage::kInteractive && renderer_.samples() > 0) return true;
        left = seconds - std::max(since(start), planned_s_);
    }
    return true;
}

bool ViewportRenderer::mustShow() const { return !updates_.empty() && updates_.back().size != size_; }

void ViewportRenderer::traceSlice(double seconds_left) {
    if (stage_ == Stage::kDenoising) return continueDenoising();
    if (stage_ == Stage::kFillCache) return fillCache();
    if (!renderer_.strip()) {
        if (!renderer_.preparePhotons()) return;
        if (!renderer_.openStrip(sliceRows(seconds_left))) return next();
    }
    const Strip strip = *renderer_.strip();
    const double predicted_s = speed().secondsFor(std::uint64_t{size_.width} * strip.sample.rows);
    // a sample that does not fit in one submission is submitted bounce by bounce
    const bool is_whole = predicted_s <= seconds_left || stage_ == Stage::kInteractive;
    const std::uint32_t passes = is_whole ? bounces() : strip.sample.pass == 0 ? 0 : 1;
    const bool shows = showsAfter(strip) && is_whole && endsIn(tracer_, view_.settings, passes);
    const auto show = [&](VkCommandBuffer commands) {
        recordRows(commands, strip.first_row, strip.sample.rows, strip.sample.number + 1);
    };
    // a preview is presented next, in the same submission
    const bool done = renderer_.traceStrip(passes, shows ? show : std::function<void(VkCommandBuffer)>(),
                                           stage_ == Stage::kInteractive ? Submission::kWithNext : Submission::kNow);
    if (renderer_.isAhead()) planned_s_ += predicted_s;
    addTimes();
    if (done) finishSlice(strip, shows);
}

/// Number of passes after the camera pass that complete a sample.
std::uint32_t ViewportRenderer::bounces() const { return std::max(view_.settings.bounces, 1u); }

/// Whether to show a strip once it is traced. With the denoiser on, the last denoised picture stays until the next one.
bool ViewportRenderer::showsAfter(const Strip& strip) const {
    return strip.sample.number == 0 || !showsDenoised() || strip.sample.number >= kCleanSamplesOfLight;
}

/// The cache is filled once there is a picture, so that the next movement can reproject it.
bool ViewportRenderer::needsCacheFill() {
    if (!shouldReproject() || renderer_.samples() == 0) return false;
    makeReprojector();
    return !reprojector_->isFilled();
}

void ViewportRenderer::makeReprojector() {
    if (!reprojector_) reprojector_ = createReprojector(device_, tracer_, display_.pixels, full_);
}

void ViewportRenderer::fillCache() {
    if (!reprojector_->fillCache(reprojectionView())) return;
    stage_ = Stage::kRefine;
    next();
}

std::uint32_t ViewportRenderer::sliceRows(double seconds_left) const {
    std::uint32_t rows = size_.height;
    if (stage_ != Stage::kInteractive) rows = std::min(rows, speed().rowsFor(kPlanned * seconds_left, size_.width));
    // passes that are known to fit in the time are traced in one submission, part by part
    const bool is_known = stage_ == Stage::kInteractive || speed().isKnown();
    const std::uint32_t parts = is_known && endsIn(tracer_, view_.settings, bounces()) ? kSamplesAtOnce : 1;
    return std::min(rows, parts * fittingRows(tracer_, size_.width));
}

void ViewportRenderer::finishSlice(const Strip& strip, bool is_drawn) {
    const std::uint32_t rows = strip.sample.rows, sample = strip.sample.number;
    const RayCounts rays = renderer_.takeRays();
    rays_ += rays.primary + rays.shadow + rays.secondary;
    if (is_drawn)
        reportRows(strip.first_row, rows, sample + 1);
    else if (showsAfter(strip))
        showRows(strip.first_row, rows, sample + 1);
    if (renderer_.rowsDone() == 0) finishSample();
}

void ViewportRenderer::addTimes() {
    for (const StripTime& each : renderer_.takeTimes()) {
        traced_seconds_ += each.seconds;
        if (!each.has_first_hits)
            (each.is_preview ? preview_speed_ : refine_speed_).addMeasurement(each.pixels, each.seconds);
    }
}

void ViewportRenderer::finishSample() {
    // from here on, the film is shown without denoising
    if (renderer_.samples() == kCleanSamplesOfLight && view_.denoise) showFilm();
    next();
}

/// Whether this stage needs first hits: full frames need them for the denoiser and for files, previews only to display
/// them.
bool ViewportRenderer::needsHits() const {
    const bool looked_at = needsFirstHits(view_.look);
    return looked_at || (stage_ == Stage::kRefine && (view_.denoise || view_.settings.first_hits));
}

FilmRange ViewportRenderer::rangeOf(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) const {
    return {size_.width * first_row, size_.width * rows, size_.width * size_.height, samples};
}

void ViewportRenderer::showRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) {
    const VkCommandBuffer commands = beginCommands(device_);
    recordRows(commands, first_row, rows, samples);
    submitAndWait(device_, commands);
    reportRows(first_row, rows, samples);
}

void ViewportRenderer::recordRows(VkCommandBuffer commands, std::uint32_t first_row, std::uint32_t rows,
                                  std::uint32_t samples) const {
    const FilmRange range = rangeOf(first_row, rows, samples);
    recordResolve(commands, display_, range, view_.look, false);
    recordTonemap(commands, display_, range, view_.look, false);
}

/// Call it after rows have been drawn to the pixels.
void ViewportRenderer::reportRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) {
    const FilmRange range = rangeOf(first_row, rows, samples);
    const float share = shareShown(samples);
    if (share < 1) reprojector_->blendWithReprojection(range.first, range.count, share);
    shows_full_frame_ =
        shows_full_frame_ || (isFullSize() && view_.look.shown == SHOWN_BEAUTY && first_row + rows == size_.height);
    updates_.push_back({size_, first_row, rows});
}

/// Weight of the film in the blend with the reprojected picture, for a smooth transition.
float ViewportRenderer::shareShown(std::uint32_t samples) const {
    const bool mixes = stage_ == Stage::kRefine && reprojection_current_ && mostly_reused_ &&
                       samples < std::min(kCleanBlendSamples, view_.settings.spp);
    return mixes ? 1 - std::pow(1 - kBlendPerSample, static_cast<float>(samples)) : 1;
}

void ViewportRenderer::continueDenoising() {
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
    stage_ = renderer_.samples() < view_.settings.spp ? Stage::kRefine : Stage::kIdle;
    if (view_.denoise && view_.look.shown == SHOWN_BEAUTY) return showDenoised();
    showFilm();
}

void ViewportRenderer::showDenoised() {
    const VkCommandBuffer commands = beginCommands(device_);
    recordTonemap(commands, display_, rangeOf(0, full_.height, renderer_.samples()), view_.look, true);
    submitAndWait(device_, commands);
    shows_full_frame_ = true;
    updates_.push_back({full_, 0, full_.height});
}

ViewportProgress ViewportRenderer::progress() const {
    ViewportProgress progress;
    progress.size = size_;
    progress.traced = stage_ == Stage::kReprojection ? reprojected_pixels_ : 0;
    progress.samples = isFullSize() ? renderer_.samples() : 0;
    progress.share = size_.height > 0 ? static_cast<double>(renderer_.rowsDone()) / size_.height : 0;
    progress.resting = stage_ == Stage::kIdle;
    progress.denoising = stage_ == Stage::kDenoising;
    progress.mrays_per_second = traced_seconds_ > 0 ? 1e-6 * static_cast<double>(rays_) / traced_seconds_ : 0;
    return progress;
}

/// Whether the picture has its full size. Previews have different light, so they never count.
bool ViewportRenderer::isFullSize() const {
    return size_ == full_ && stage_ != Stage::kInteractive && stage_ != Stage::kReprojection &&
           stage_ != Stage::kCoarse;
}

bool ViewportRenderer::isBetweenSamples() const {
    return renderer_.samples() > 0 && isFullSize() && renderer_.rowsDone() == 0 && !renderer_.strip();
}

std::optional<Pick> ViewportRenderer::pick(std::uint32_t x, std::uint32_t y) {
    if (x >= full_.width || y >= full_.height) return std::nullopt;
    return pickPixel(device_, tracer_, view_.settings, view_.camera, x, y);
}

Film ViewportRenderer::readFilm() { return renderer_.takeFilm(); }

std::uint64_t ViewportRenderer::deviceBytes() const {
    return pointrt::deviceBytes(tracer_) + pointrt::deviceBytes(display_) + (reprojector_ ? reprojector_->bytes() : 0);
}

} // namespace pointrt

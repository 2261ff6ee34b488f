// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/image_controller.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pointrt {
namespace {

/// Tracing time in a frame at rest: the next input must not wait noticeably.
constexpr double kRefineBudget_s = 0.018;

PixelSize sizeOf(const Viewport& view) { return {view.settings.width, view.settings.height}; }

std::uint32_t pixelAt(double share, std::uint32_t pixels) {
    return static_cast<std::uint32_t>(std::clamp(share * pixels, 0.0, pixels - 1.0));
}

} // namespace

ImageChange changeOf(const std::optional<Viewport>& shown, const ImageRequest& request, bool restart) {
    if (!shown || restart || shown->camera != request.view.camera || sizeOf(*shown) != sizeOf(request.view))
        return ImageChange::kStartOver;
    return request.look_changed ? ImageChange::kLook : ImageChange::kNone;
}

void ImageController::open(Device& device, BandTracer& tracer) {
    close();
    device_ = &device;
    tracer_ = &tracer;
}

void ImageController::close() {
    live_.reset();
    shown_.reset();
    tracer_ = nullptr;
}

std::optional<PickResult> ImageController::update(const ImageRequest& request) {
    if (!live_) live_.emplace(*device_, *tracer_, budget_.next({}, 0));
    setBudget(request.display_hz);
    moved_ = false;
    paused_ = request.paused;
    const ImageChange change = changeOf(shown_, request, pending_restart_.has_value());
    if (change == ImageChange::kStartOver) {
        moved_ = shown_.has_value();
        const ViewChange scene = pending_restart_.value_or(ViewChange::kCamera);
        shown_ = request.view;
        shown_->settings.first_hits = true;
        // after kAll, a preview reprojected from the former picture would show things that are gone
        live_->setView(*shown_, scene != ViewChange::kAll, scene);
        pending_restart_.reset();
    } else if (change == ImageChange::kLook) {
        live_->setLook(request.view.look, request.view.denoise);
    }
    live_->setSamples(request.view.settings.spp);
    return findPick();
}

/// On a CPU device, the cores also do the host's own work for each frame.
void ImageController::setBudget(std::optional<double> display_hz) {
    const bool is_cpu = device_->type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    preview_budget_s_ =
        budget_.next(display_hz, is_cpu ? std::numeric_limits<double>::infinity() : live_->previewSeconds());
    live_->setPreviewBudget(preview_budget_s_);
}

/// Only between slices, since a pick uses the tracer's buffers.
std::optional<PickResult> ImageController::findPick() {
    if (!pick_ || !live_->isBetweenSlices()) return std::nullopt;
    const PickRequest request = *std::exchange(pick_, std::nullopt);
    const PixelSize full = sizeOf(live_->view());
    const std::optional<Pick> pick = live_->pick(pixelAt(request.x, full.width), pixelAt(request.y, full.height));
    return pick ? std::optional(PickResult{*pick, request.centre}) : std::nullopt;
}

bool ImageController::mayWork() const {
    return !paused_ || moved_ || hasPendingRequest() || live_->progress().samples == 0;
}

bool ImageController::work() { return mayWork() && live_->work(moved_ ? preview_budget_s_ : kRefineBudget_s); }

Film ImageController::takeFilm() {
    film_requested_ = false;
    return live_->readFilm();
}

PixelSize ImageController::size() const { return shown_ ? sizeOf(*shown_) : PixelSize{0, 0}; }

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// From the workspace to the picture on the screen.
#include <algorithm>

#include "runtime/session/report.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/edit/pick_details.h"

namespace pointrt {
namespace {

/// Of a frame at 30 a second, what tracing may take; the rest is the interface's and the display's, and a reserve.
constexpr double kMovingBudget_s = 0.015;
/// Nobody waits for a picture that gets finer, but the next input must not wait long for it either.
constexpr double kRestingBudget_s = 0.018;

/// As long as nothing happens, the interface is drawn this often.
constexpr double kUndrawn_s = 0.1;

} // namespace

void Window::beginPicture() {
    live_.emplace(host_.device(), loaded_->tracer, kMovingBudget_s);
    shown_camera_.reset();
}

void Window::updatePicture() {
    frame_moved_ = false;
    if (!loaded_ || refurnish_) return;
    if (!live_) beginPicture();
    const Camera camera = cameraOf(work_.camera);
    const PixelSize pixels = host_.pixels();
    const bool resized = pixels.width != shown_pixels_.width || pixels.height != shown_pixels_.height;
    if (shown_camera_ != camera || resized || restart_) {
        Viewport view{work_.settings, camera, work_.look, work_.denoise};
        view.settings.width = pixels.width;
        view.settings.height = pixels.height;
        view.settings.spp = work_.samples_wanted;
        view.settings.first_hits = true;
        live_->setView(view, true);
        frame_moved_ = shown_camera_.has_value();
        shown_camera_ = camera;
        shown_pixels_ = pixels;
        restart_ = false;
    } else if (work_.requests.look_changed) {
        live_->setLook(work_.look, work_.denoise);
    }
    work_.requests.look_changed = false;
    live_->setSamples(work_.samples_wanted);
    resolvePicks();
    if (mayWork() && live_->work(frame_moved_ ? kMovingBudget_s : kRestingBudget_s)) refineUndrawn();
    uploadPicture();
    if (screenshot_wanted_ && live_->betweenSamples() && !save_) takeScreenshot();
}

/// Paused, only what the user waits for goes on: a first picture, one to be saved, and a slice that a pick waits for.
bool Window::mayWork() const {
    return !work_.paused || frame_moved_ || screenshot_wanted_ || pick_ || live_->progress().samples == 0;
}

/// While nobody does anything the interface needs no drawing, and the picture gets all the time; input is looked for as
/// often as ever.
void Window::refineUndrawn() {
    while (!frame_moved_ && !any_input_ && !controls_.drag && !flight_ && !work_.job && !live_->mustShow()) {
        const Clock::time_point now = Clock::now();
        if (std::chrono::duration<double>(now - last_frame_).count() > kUndrawn_s || live_->betweenSamples()) return;
        report_.resting_ms.push_back(std::chrono::duration<double, std::milli>(now - looked_).count());
        early_input_ = host_.poll(0);
        looked_ = now;
        if (!early_input_.empty()) return;
        if (!live_->work(kRestingBudget_s)) return;
    }
}

void Window::uploadPicture() {
    if (live_->updates().empty()) return;
    const PixelSize canvas = host_.pixels();
    if (canvas.width != shown_pixels_.width || canvas.height != shown_pixels_.height)
        return live_->clearUpdates(); // the window has changed meanwhile: its picture comes with the next frame
    const VkCommandBuffer commands = beginCommands(host_.device());
    std::optional<PictureSize> scaled;
    for (const PictureUpdate& update : live_->updates())
        if (update.size == PictureSize{canvas.width, canvas.height})
            recordUploadRows(commands, host_.presenter(), live_->pixels(), update.first_row, update.rows);
        else
            scaled = update.size;
    submitAndWait(host_.device(), commands);
    live_->clearUpdates();
    if (scaled) uploadScaled(host_.device(), host_.presenter(), live_->pixels(), scaled->width, scaled->height);
    if (report_.first_picture_s < 0) report_.first_picture_s = secondsSinceStart();
}

void Window::fillHud() {
    HudFigures& hud = work_.hud;
    hud.device = host_.device().name;
    hud.frame_ms = mean_frame_ms_;
    hud.samples_wanted = work_.samples_wanted;
    hud.splats = loaded_ ? loaded_->scene.splat_count : 0;
    if (!loaded_ || !live_ || refurnish_) return;
    const ViewportProgress progress = live_->progress();
    hud.device_bytes = loaded_->scene.device_bytes + live_->deviceBytes();
    hud.samples = progress.samples;
    hud.sample_share = progress.share;
    hud.resting = progress.resting;
    hud.picture_width = progress.size.width;
    hud.picture_height = progress.size.height;
    hud.mrays_per_second = progress.mrays_per_second;
}

/// Between slices: a pick borrows the tracer's buffers.
void Window::resolvePicks() {
    if (!pick_ || !live_->betweenSlices()) return;
    const PickRequest request = *pick_;
    pick_.reset();
    const ViewSize size = viewSize();
    const Viewport& view = live_->view();
    const auto pixel = [](double at, double units, std::uint32_t pixels) {
        return static_cast<std::uint32_t>(std::clamp(at / units * pixels, 0.0, pixels - 1.0));
    };
    const std::optional<Pick> pick = live_->pick(pixel(request.x, size.width, view.settings.width),
                                                 pixel(request.y, size.height, view.settings.height));
    if (!pick) return;
    if (request.centre) return flyTo(centredOn(work_.camera, pick->position));
    work_.picks.push_back(describePick(loaded_->scene, *pick));
    if (work_.picks.size() > 2) work_.picks.erase(work_.picks.begin());
}

} // namespace pointrt

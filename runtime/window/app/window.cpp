// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/app/window.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "runtime/session/report.h"
#include "runtime/util/interrupt.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/ui/panel_ui.h"
#include "runtime/window/widgets/ui_style.h"

namespace pointrt {
namespace {

/// Without anything to do the window looks for input this often: jobs and notices move on.
constexpr double kIdle_s = 0.1;
constexpr double kNotice_s = 6;
/// Of replays and recordings, and of what moves by itself.
constexpr double kReplayedFrame_s = 1.0 / 30;
/// Of a new frame's time in the mean that the window shows: a second's worth at 30 frames a second.
constexpr double kMeanShare = 1.0 / 30;

HostRequest hostRequest(const Options& options, const std::optional<Replay>& replay) {
    HostRequest request;
    request.device = options.device;
    request.verbose = options.verbose;
    request.offscreen = options.offscreen;
    request.title = "pointrt";
    const PixelSize size = options.choices.size.value_or(PixelSize{request.width, request.height});
    request.width = size.width;
    request.height = size.height;
    if (!replay) return request;
    request.width = replay->window().width;
    request.height = replay->window().height;
    request.scale = replay->window().scale;
    return request;
}

std::optional<Replay> openReplay(const Options& options) {
    if (options.replay.empty()) return std::nullopt;
    return Replay(readRecording(options.replay));
}

} // namespace

Window::Ui::Ui() : context(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr; // the window leaves no files behind
    setUpUiInput();
}

Window::Ui::~Ui() { ImGui::DestroyContext(context); }

Window::Window(const Options& options)
    : options_(options), replay_(openReplay(options)), host_(hostRequest(options, replay_)) {
    if (!options.record.empty()) recorder_ = openRecording(options.record, host_.size());
    host_.useClipboardForUi();
    fitText();
    open(options.scene);
}

Window::~Window() {
    save_.reset();
    turntable_.reset();
    bake_.reset();
    load_.reset();
    refurnish_.reset();
    live_.reset();
    loaded_.reset();
}

/// Fonts as large as the screen wants them.
void Window::fitText() {
    text_scale_ = host_.size().scale;
    setUpUiStyle(host_.textScale(), static_cast<float>(text_scale_));
    setUiFont(host_.device(), host_.presenter());
}

/// Replays go by their frames, so that the same recording does the same on any machine.
double Window::now() const {
    if (replay_) return frame_ * kReplayedFrame_s;
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

/// Recordings go by the clock: frames of a replay are all as long.
std::uint32_t Window::recordedFrame() const { return static_cast<std::uint32_t>(now() / kReplayedFrame_s + 0.5); }

void Window::tell(const std::string& text, bool error) {
    work_.notices.push_back({text, error, now() + kNotice_s});
    if (options_.verbose || error) std::fprintf(stderr, "pointrt-view: %s%s\n", error ? "error: " : "", text.c_str());
}

/// How long to wait for input: not at all where there is work, as long as the eye does not notice where something is
/// shown that moves by itself.
double Window::patience() const {
    const bool traces = live_ && !refurnish_ && mayWork() && !live_->progress().resting;
    if (replay_ || traces || flight_ || length(flying_) > 0 || any_input_ || screenshot_wanted_ || pick_) return 0;
    return work_.job || !work_.notices.empty() || controls_.drag ? kReplayedFrame_s : kIdle_s;
}

std::vector<InputEvent> Window::gatherInput() {
    std::vector<InputEvent> events = std::exchange(early_input_, {});
    if (events.empty()) events = host_.poll(patience());
    if (!replay_) return events;
    // a replayed window listens to its own size alone
    std::erase_if(events, [](const InputEvent& event) { return !std::holds_alternative<ResizeEvent>(event); });
    ReplayFrame replayed = replay_->next(pictureState());
    for (InputEvent& event : replayed.events) {
        if (const auto* size = std::get_if<ResizeEvent>(&event)) host_.resize(*size);
        events.push_back(std::move(event));
    }
    for (std::string& name : replayed.screenshots) frame_shots_.push_back(std::move(name));
    quit_ |= replayed.quit;
    return events;
}

PictureState Window::pictureState() const {
    PictureState state;
    state.busy = busy() || bake_ || turntable_ || save_ || screenshot_wanted_ || edits_wait_;
    if (!live_ || refurnish_) return state;
    const ViewportProgress progress = live_->progress();
    state.busy |= progress.denoising;
    state.samples = progress.samples;
    state.grows = !progress.resting && !work_.paused;
    return state;
}

void Window::drawInterface(double seconds) {
    work_.time_s = now();
    std::erase_if(work_.notices, [&](const Notice& notice) { return notice.until_s < work_.time_s; });
    beginUiFrame(ui_input_, host_.size(), seconds);
    drawUi(work_);
    ImGui::Render();
    host_.setCursor(uiCursor());
}

void Window::present() { pointrt::present(host_.device(), host_.presenter(), ImGui::GetDrawData()); }

void Window::noteTimes(Clock::time_point start) {
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    mean_frame_ms_ += (mean_frame_ms_ == 0 ? 1 : kMeanShare) * (ms - mean_frame_ms_);
    if (!live_) return;
    const ViewportProgress progress = live_->progress();
    if (frame_moved_) {
        report_.moving_ms.push_back(ms);
        report_.moving_pixels.push_back(double{1} * progress.size.width * progress.size.height);
        moved_ = Clock::now();
        report_.clean_s = -1;
    } else if (!progress.resting) {
        report_.resting_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - looked_).count());
    }
    if (report_.clean_s < 0 && progress.samples >= kCleanSamples)
        report_.clean_s = std::chrono::duration<double>(Clock::now() - moved_).count();
}

bool Window::frame() {
    const std::vector<InputEvent> events = gatherInput();
    const Clock::time_point start = looked_ = Clock::now();
    const double passed = std::max(1e-4, std::chrono::duration<double>(start - last_frame_).count());
    const double seconds = replay_ ? kReplayedFrame_s : passed;
    last_frame_ = start;
    any_input_ = !events.empty();
    for (const InputEvent& event : events) {
        if (recorder_) record(*recorder_, {recordedFrame(), event});
        handle(event);
    }
    ++frame_;
    pollJobs();
    moveCamera(seconds);
    if (host_.minimised()) { // nobody sees it: go on slowly
        early_input_ = host_.poll(kIdle_s);
        return !quit_;
    }
    if (host_.size().scale != text_scale_) fitText();
    fillHud();
    drawInterface(seconds);
    applyRequests();
    updatePicture();
    present();
    noteTimes(start);
    for (const std::string& name : std::exchange(frame_shots_, {})) takeFrame(name);
    return !quit_ || save_ || (screenshot_wanted_ && live_); // who asked for a picture gets it
}

void Window::run() {
    noteInterrupts();
    while (frame() && !interrupted()) continue;
    report_.device = host_.device().name;
    report_.width = host_.pixels().width;
    report_.height = host_.pixels().height;
    if (!options_.stats.empty()) writeText(options_.stats, windowReportJson(report_));
}

void runWindow(const Options& options) { Window(options).run(); }

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The frame loop: input, commands and requests.
#include "runtime/window/app/window.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/base/report_file.h"
#include "format/os/interrupt.h"
#include "format/os/user_folder.h"
#include "runtime/session/report.h"
#include "runtime/util/clock.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/edit/actions.h"
#include "runtime/window/edit/preferences.h"
#include "runtime/window/edit/recent_files.h"
#include "runtime/window/edit/shown_scene.h"
#include "runtime/window/input/camera_commands.h"
#include "runtime/window/input/camera_text.h"

namespace pointrt {
namespace {

/// Poll interval when idle, for jobs and notices.
constexpr double kIdle_s = 0.1;
constexpr double kNotice_s = 6;
constexpr double kError_s = 20; // time to read a long path and a reason twice

HostRequest hostRequest(const Options& options, const RecordReplay& tape) {
    HostRequest request;
    request.device = options.device;
    request.traversal = options.traversal;
    request.verbose = options.verbose;
    request.offscreen = options.offscreen;
    request.title = "pointrt";
    const PixelSize size = options.choices.size.value_or(PixelSize{request.width, request.height});
    request.width = size.width;
    request.height = size.height;
    if (!tape.isReplaying()) return request;
    request.width = tape.window().width;
    request.height = tape.window().height;
    request.scale = tape.window().scale;
    return request;
}

ViewSize viewSize(const Host& host) {
    const ResizeEvent size = host.size();
    return {std::max(1.0, double(size.width)), std::max(1.0, double(size.height))};
}

/// Whether command may be executed while a question is open.
bool isAnswer(const Command& command) {
    const auto* action = std::get_if<Action>(&command);
    return action ? *action == Action::kBack : std::holds_alternative<ResizeEvent>(command);
}

double aspectOf(ViewSize size) { return size.width / size.height; }

/// live: null while it must not be used.
void fillHud(Workspace& work, Host& host, const LoadedScene* loaded, const ViewportRenderer* live) {
    HudStats& hud = work.hud;
    hud.device = host.device().name;
    hud.target_samples = work.target_samples;
    hud.splats = loaded ? loaded->scene.splat_count : 0;
    hud.tiles = loaded && !loaded->scene.sets.empty() ? loaded->scene.instances.size() : 0;
    if (!loaded || !live) return;
    const ViewportProgress progress = live->progress();
    hud.device_bytes = loaded->scene.device_bytes + live->deviceBytes();
    hud.samples = progress.samples;
    hud.sample_share = progress.share;
    hud.resting = progress.resting;
    hud.picture_width = progress.size.width;
    hud.picture_height = progress.size.height;
    hud.mrays_per_second = progress.mrays_per_second;
}

std::optional<ShownPicture> shownPicture(const ImageController& image) {
    if (!image.live()) return std::nullopt;
    const ViewportProgress progress = image.live()->progress();
    const double all = double{1} * progress.size.width * progress.size.height;
    const double pixels = progress.traced > 0 ? static_cast<double>(progress.traced) : all;
    return ShownPicture{image.moved(), progress.resting, progress.samples, pixels};
}

} // namespace

Window::Window(const Options& options, std::optional<ReopenedWindow> reopened)
    : options_(options), session_(reopened ? std::move(reopened->session) : RecordReplay(options.replay)),
      host_(hostRequest(options, session_)), ui_(host_), meter_(Clock::now()), editor_(work_),
      jobs_([this](const std::string& text, bool error) { notify(text, error); }),
      opener_(
          jobs_, [this](const std::string& text, bool error) { notify(text, error); },
          [this](const SceneSource& scene, bool first) { return startLoad(scene, first); }) {
    if (!options.record.empty() && !reopened) session_.startRecording(options.record, host_.size());
    work_.recent_files = recentFiles(userStateFolder());
    if (!session_.isReplaying()) readPreferences(userStateFolder(), work_); // replays look the same everywhere
    if (reopened) {
        const char* const end =
            reopened->lacks_pictures ? "; pictures that were still being saved must be saved again" : "";
        notify(std::string("the graphics device was lost and has been opened again") + end, true);
        kept_view_ = reopened->view;
    }
    if (reopened && reopened->scene)
        opener_.open(*reopened->scene);
    else if (!options.inputs.empty())
        opener_.openNamed({options.inputs, options.bake_options});
}

void Window::notify(const std::string& text, bool error) {
    work_.notices.push_back({text, error, session_.now() + (error ? kError_s : kNotice_s)});
    if (options_.verbose || error)
        std::fprintf(stderr, "pointrt-view: %s%s\n", error ? "error: " : "",
                     printable(text, std::string::npos).c_str());
}

/// Runs body. An error becomes a notice that starts with subject.
void Window::tryOrNotify(const std::string& subject, const std::function<void()>& body) {
    try {
        body();
    } catch (const Error& error) {
        notify(subject + error.what(), true);
    }
}

/// How long to wait for input: not at all while there is work, one frame while an animation runs.
double Window::inputTimeout() const {
    const bool traces =
        image_.live() && !jobs_.has(JobKind::kSceneUpdate) && image_.mayWork() && !image_.live()->progress().resting;
    // a replay need not be displayed smoothly, but drawing while it loads would slow down the loading
    const bool hurries = session_.isReplaying() && image_.live();
    if (hurries || traces || view_.moves() || input_.any || image_.hasPendingRequest()) return 0;
    return work_.job || dialog_ || !work_.notices.empty() || ui_.isDragging() ? kReplayFrame_s : kIdle_s;
}

std::vector<InputEvent> Window::collectInput() {
    std::vector<InputEvent> events = std::exchange(input_.pending, {});
    if (events.empty()) events = host_.poll(inputTimeout());
    if (!session_.isReplaying()) return events;
    // a replay ignores the real window's events, except changes of size
    std::erase_if(events, [](const InputEvent& event) { return !std::holds_alternative<ResizeEvent>(event); });
    ReplayFrame replayed = session_.next(pictureState());
    for (InputEvent& event : replayed.events) {
        if (const auto* size = std::get_if<ResizeEvent>(&event)) host_.resize(*size);
        events.push_back(std::move(event));
    }
    for (std::string& name : replayed.screenshots) input_.screenshots.push_back(std::move(name));
    quit_ |= replayed.quit;
    return events;
}

PictureState Window::pictureState() const {
    PictureState state;
    state.busy = jobs_.any() || needsTiles() || image_.isFilmRequested() || editor_.hasPendingEdits();
    if (!image_.live() || jobs_.has(JobKind::kSceneUpdate)) return state;
    const ViewportProgress progress = image_.live()->progress();
    state.busy |= progress.denoising;
    state.samples = progress.samples;
    state.grows = !progress.resting && !work_.paused;
    return state;
}

void Window::execute(const Command& command) {
    if (work_.question && !isAnswer(command)) return;
    const ViewSize size = viewSize(host_);
    if (const auto view = cameraAfter(command, work_.camera, size)) {
        view_.stop();
        work_.camera = *view;
    }
    const bool has_picture = loaded_ || jobs_.any(); // a picture is shown, or will be soon
    if (const auto* at = std::get_if<PickCommand>(&command); at && has_picture)
        image_.pick({at->x / size.width, at->y / size.height});
    if (const auto* at = std::get_if<CentreCommand>(&command); at && has_picture)
        image_.pick({at->x / size.width, at->y / size.height, true});
    if (const auto* fly = std::get_if<FlyCommand>(&command)) view_.flyAlong(fly->direction);
    if (const auto* drop = std::get_if<DropEvent>(&command)) openFiles(drop->paths);
    if (const auto* action = std::get_if<Action>(&command)) execute(*action);
}

void Window::execute(Action action) {
    if (const auto view = cameraForAction(action, work_.camera, view_.home, viewSize(host_))) return flyTo(*view);
    if (applyAction(work_, action)) return;
    if (action == Action::kCopyCamera) host_.setClipboard(cameraText(work_.camera));
    if (action == Action::kPasteCamera)
        tryOrNotify("", [&] { flyTo(withCameraText(work_.camera, host_.clipboard())); });
    if (action == Action::kPreviousFile || action == Action::kNextFile)
        afterSaving(
            [this, step = action == Action::kNextFile ? 1 : -1] { opener_.openNeighbour(work_.scene.path, step); });
}

void Window::handleRequests() {
    const Requests requests = std::exchange(work_.requests, {});
    work_.requests.look_changed = requests.look_changed; // updatePicture resets it
    const double aspect = aspectOf(viewSize(host_));
    if (requests.up && loaded_) {
        if (changesScene(jobs_)) {
            notify("wait until the scene has been loaded or updated", true);
        } else {
            editor_.setUp(*requests.up, view_.home, aspect);
            flyTo(view_.home);
        }
    }
    editor_.noteRequests(requests);
    // edits wait for tiles that are being loaded, which takes a moment
    handleEdits(requests);
    if (loaded_ && !changesScene(jobs_) && !jobs_.has(JobKind::kTiles))
        editScene(requests.dragging, requests.dragging || requests.typing);
    if (requests.action) execute(*requests.action);
    if (requests.quit) afterSaving([this] { quitAfterPictures(); });
    if (requests.cancel_job) jobs_.cancel();
    if (requests.home) flyTo(view_.home);
    if (requests.save_view) saveView(work_);
    if (requests.screenshot && loaded_) image_.requestFilm();
    if (requests.bake_again && loaded_)
        afterSaving([this, kind = *requests.bake_again] {
            kept_view_ = KeptView{work_.scene.path, work_.camera, view_.home};
            tryOrNotify("", [&] { opener_.bakeAgain(kind); });
        });
    if (requests.save_outline && loaded_) tryOrNotify("", [&] { saveOutline(*requests.save_outline); });
    if (requests.compare && loaded_) tryOrNotify("", [&] { compareScans(*requests.compare); });
    if (requests.find_place && !std::exchange(work_.place_sought, true))
        tryOrNotify("", [&] { work_.earth_place = earthPlaceOf(work_.scene); });
    if (requests.add_still && loaded_) addStill();
    startStill();
    if (requests.turntable_pictures && loaded_)
        tryOrNotify("", [&] { renderTurntable(*requests.turntable_pictures, requests.follows_views); });
    std::vector<NamedView>& views = work_.scene.views;
    if (requests.go_to_view && *requests.go_to_view < views.size()) {
        const NamedView& view = views[*requests.go_to_view];
        tryOrNotify(view.name + ": ", [&] {
            flyTo(framedView(view.camera, work_.scene_min, work_.scene_max, sceneUp(work_.scene, work_.settings),
                             aspect));
        });
    }
    if (requests.delete_view && *requests.delete_view < views.size())
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*requests.delete_view));
}

bool Window::frame() {
    const std::vector<InputEvent> events = collectInput();
    const double seconds = session_.frameSeconds(meter_.begin(Clock::now()));
    input_.any = !events.empty();
    for (const InputEvent& event : events) {
        session_.recordStep(event);
        for (const Command& command : ui_.handleEvent(event, session_.now())) execute(command);
    }
    session_.endFrame();
    const bool changed_scene = changesScene(jobs_);
    jobs_.poll();
    // a replay must wait for this too
    if (changed_scene && !changesScene(jobs_)) session_.recordStep(WaitStep{1});
    work_.job = jobs_.status();
    work_.camera = view_.advanced(work_.camera, session_.now(), seconds);
    if (host_.minimised()) { // not visible: idle
        input_.pending = host_.poll(kIdle_s);
        return !quit_ && (!work_.requests.quit || editor_.isModified());
    }
    work_.time_s = session_.now();
    work_.scan_in_view = editor_.seesScans(work_.camera, viewSize(host_));
    std::erase_if(work_.notices, [&](const Notice& notice) { return notice.until_s < work_.time_s; });
    work_.may_bake_again = opener_.mayBakeAgain(work_.scene.path);
    work_.hud.frame_ms = meter_.meanFrame_ms();
    work_.hud.tiles_loading = jobs_.has(JobKind::kTiles);
    fillHud(work_, host_, loaded_.get(), jobs_.has(JobKind::kSceneUpdate) ? nullptr : image_.live());
    if (loaded_) updateHistograms();
    ui_.draw(work_, seconds);
    handleRequests();
    autosave();
    requestTiles();
    updatePicture();
    ui_.present(std::exchange(uploads_, {}));
    meter_.end(Clock::now(), shownPicture(image_));
    for (const std::string& name : std::exchange(input_.screenshots, {})) ui_.savePng(name + ".png");
    return !quit_ || jobs_.has(JobKind::kSave) ||
           (image_.isFilmRequested() && image_.live()); // completes a requested picture
}

void Window::run() {
    catchInterrupts();
    while (frame() && !interrupted()) continue;
    if (!session_.isReplaying()) writePreferences(userStateFolder(), work_);
    if (autosave_ && !interrupted()) autosave_->discard(); // its edits are saved, or not wanted
    WindowReport& report = meter_.report;
    report.device = host_.device().name;
    report.width = host_.pixels().width;
    report.height = host_.pixels().height;
    if (!options_.stats.empty()) writeReport(options_.stats, windowReportJson(report));
}

void runWindow(const Options& options) {
    auto window = std::make_unique<Window>(options);
    std::optional<ReopenedWindow> left;
    try {
        return window->run();
    } catch (const DeviceLost&) {
        left = window->handOver();
    }
    window.reset();                         // a process has one device at a time
    Window(options, std::move(left)).run(); // if the device is lost again, the program ends; edits are in the autosave
}

} // namespace pointrt

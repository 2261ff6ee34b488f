// SPDX-License-Identifier: Apache-2.0
// Loading scenes, and keeping them as the panels have them.
#include <filesystem>
#include <utility>

#include "format/base/error.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene_file/scene_file.h"
#include "runtime/session/settings.h"
#include "runtime/window/app/window_state.h"

namespace pointrt {
namespace {

bool opensAtOnce(const std::string& path) { return path.ends_with(".pro") || isSceneFile(path); }

/// Materials at the end of the list that nothing is of: those of a room that was taken down.
void dropUnused(SceneDescription& scene, std::size_t fewest) {
    const auto isUsed = [&](std::uint32_t number) {
        for (const ShapeDescription& shape : scene.shapes)
            if (shape.material == number) return true;
        for (const InstanceDescription& instance : scene.instances) {
            if (instance.material == number) return true;
            for (const MaterialOverride& each : instance.overrides)
                if (each.material == number) return true;
        }
        return false;
    };
    while (scene.materials.size() > fewest && !isUsed(static_cast<std::uint32_t>(scene.materials.size() - 1)))
        scene.materials.pop_back();
}

} // namespace

bool Window::busy() const { return load_ || refurnish_ || next_path_; }

/// What is being loaded is given up; what is being relit is not, for a moment.
void Window::open(const std::string& path) {
    next_path_ = path;
    if (load_) load_->job().cancel();
}

void Window::startLoad(const std::string& path) {
    Options options = options_;
    options.scene = path;
    if (loaded_) { // what the command line says of the camera is of its scene
        options.camera = {};
        options.fov_deg.reset();
        options.view.clear();
    }
    options.choices.size = host_.pixels();
    load_ = std::make_unique<LoadJob>(host_.device(), options);
    host_.setTitle(std::filesystem::path(path).filename().string() + " - pointrt");
}

void Window::drop(const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    try {
        if (opensAtOnce(paths.front())) {
            if (paths.size() > 1) tell("opening the first of " + std::to_string(paths.size()) + " files");
            return open(paths.front());
        }
        if (bake_) return tell("one scan after the other: " + bake_->job().figures().what + " is under way", true);
        const BakePlan plan = planBake(paths);
        if (plan.is_there) return open(plan.output);
        bake_ = std::make_unique<BakeJob>(plan);
    } catch (const Error& error) {
        tell(error.what(), true);
    }
}

void Window::pollJobs() {
    const bool was_busy = busy();
    const auto tellEnd = [&](const Job& job) {
        if (job.state() == JobState::kFailed) tell(job.error(), true);
        if (job.state() == JobState::kCancelled) tell(job.figures().what + ": cancelled");
        return job.state() == JobState::kDone;
    };
    if (bake_ && bake_->job().ended()) {
        const std::unique_ptr<BakeJob> bake = std::move(bake_);
        if (tellEnd(bake->job())) open(bake->output());
    }
    if (refurnish_ && refurnish_->job().ended()) {
        const std::unique_ptr<RefurnishJob> done = std::move(refurnish_);
        tellEnd(done->job());
        restart_ = true;
    }
    if (turntable_ && turntable_->job().ended()) {
        const std::unique_ptr<TurntableJob> done = std::move(turntable_);
        if (tellEnd(done->job())) tell("rendered " + work_.turntable_path);
    }
    if (save_ && save_->job().ended()) {
        const std::unique_ptr<SaveJob> done = std::move(save_);
        if (done->job().state() == JobState::kFailed && quit_)
            throw Error{done->job().errorCode(), done->job().error()};
        if (tellEnd(done->job())) tell(done->done());
    }
    if (load_ && load_->job().ended()) {
        const std::unique_ptr<LoadJob> load = std::move(load_);
        // what the command line named; of files that are dropped on an empty window there may be others
        const bool first = !std::exchange(first_has_loaded_, true);
        if (load->job().state() == JobState::kFailed && first)
            throw Error{load->job().errorCode(), load->job().error()};
        if (tellEnd(load->job())) showLoaded(load->take());
    }
    if (next_path_ && !load_ && !refurnish_) startLoad(*std::exchange(next_path_, std::nullopt));
    // a replay must not go on before what has ended here
    if (was_busy && !busy() && recorder_) record(*recorder_, {recordedFrame(), WaitStep{1}});
    work_.job.reset();
    if (save_) work_.job = save_->job().figures();
    if (turntable_) work_.job = turntable_->job().figures();
    if (bake_) work_.job = bake_->job().figures();
    if (refurnish_) work_.job = refurnish_->job().figures();
    if (load_) work_.job = load_->job().figures();
}

void Window::cancelJob() {
    if (load_) return load_->job().cancel();
    if (refurnish_) return refurnish_->job().cancel();
    if (bake_) return bake_->job().cancel();
    if (turntable_) turntable_->job().cancel();
}

void Window::showLoaded(std::unique_ptr<LoadedScene> loaded) {
    live_.reset();
    loaded_ = std::move(loaded);
    const DeviceScene& scene = loaded_->scene;
    work_.scene = staged_ = scene.description;
    work_.settings = loaded_->settings;
    work_.scene_min = scene.bounds.lo;
    work_.scene_max = scene.bounds.hi;
    work_.scene_up = sceneUp(scene.description, work_.settings);
    work_.title = std::filesystem::path(scene.description.path).filename().string();
    work_.picks.clear();
    lamps_.clear();
    staged_room_ = work_.settings.room;
    staged_lights_ = work_.settings.lights;
    const Vec3 centre = 0.5 * (scene.bounds.lo + scene.bounds.hi);
    work_.camera = home_ = viewOf(loaded_->camera, work_.settings.camera.target.value_or(centre), scene.bounds.lo,
                                  scene.bounds.hi, sceneUp(scene.description, work_.settings));
    work_.look = {SHOWN_BEAUTY, work_.settings.exposure, 4 * length(scene.bounds.hi - scene.bounds.lo),
                  scene.space.scale};
    work_.samples_wanted =
        options_.choices.spp || scene.description.render.spp ? work_.settings.spp : kCleanSamplesOfLight;
    work_.denoise = work_.settings.denoise == DenoiseChoice::kOn ||
                    (work_.settings.denoise == DenoiseChoice::kAuto && isNoisy(work_.settings, work_.scene));
    flight_.reset();
    shown_camera_.reset();
    edits_wait_ = false;
}

void Window::keepLamps(const std::optional<Room>& room) {
    if (work_.scene.lights == staged_.lights && work_.scene.sky == staged_.sky) return;
    std::erase_if(lamps_, [&](const Lamps& each) { return each.room == room; });
    lamps_.push_back({room, work_.scene.lights, work_.scene.sky});
}

/// Puts up the room that the settings ask for in place of the one there was, with the lamps that it had last: those of
/// one room would not reach into another. A scene file's own are in every room.
void Window::restage() {
    const bool has_own_light = !loaded_->described.lights.empty() || loaded_->described.sky;
    // left to the rule, hard lamps are not filtered: it would blur what mirrors show
    const bool by_rule =
        work_.settings.denoise == DenoiseChoice::kAuto && work_.denoise == isNoisy(work_.settings, staged_);
    keepLamps(staged_room_);
    if (work_.settings.lights != staged_lights_) // another number of them: no longer those there were
        std::erase_if(lamps_, [&](const Lamps& each) { return each.room == work_.settings.room; });
    staged_room_ = work_.settings.room;
    staged_lights_ = work_.settings.lights;
    SceneDescription scene = loaded_->described;
    const std::size_t fewest = scene.materials.size();
    scene.materials = work_.scene.materials;
    scene.instances = work_.scene.instances;
    scene.views = work_.scene.views;
    if (has_own_light) {
        scene.lights = work_.scene.lights;
        scene.sky = work_.scene.sky;
    }
    Camera camera = loaded_->camera;
    camera.eye = loaded_->staged_for;
    dropUnused(scene, fewest);
    addSurroundings(scene, work_.settings, camera, work_.scene_min, work_.scene_max);
    work_.scene = staged_ = std::move(scene);
    for (const Lamps& each : lamps_)
        if (!has_own_light && each.room == work_.settings.room) {
            work_.scene.lights = each.lights;
            work_.scene.sky = each.sky;
        }
    if (by_rule) work_.denoise = isNoisy(work_.settings, work_.scene);
}

/// Puts the scan on another side: the view, and what stands around, begin anew.
void Window::setUp(Vec3 up) {
    if (busy()) return tell("not while a scene is being loaded or relit", true);
    const Vec3 centre = 0.5 * (work_.scene_min + work_.scene_max);
    const Vec3 front = std::abs(up.z) > 0.5 ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
    CameraRequest request = requestOf(home_);
    request.eye = centre + length(home_.eye - centre) * front;
    request.target = centre;
    request.up = up;
    const ViewSize size = viewSize();
    home_ = framedView(request, work_.scene_min, work_.scene_max, up, size.width / size.height);
    flyTo(home_);
    loaded_->described.up = work_.scene_up = up;
    loaded_->staged_for = home_.eye;
    loaded_->camera = cameraOf(home_);
    staged_ = work_.scene;
    lamps_.clear();
    restage();
    edits_wait_ = true;
}

void Window::refurnishLater() {
    edits_wait_ = false;
    refurnish_ = std::make_unique<RefurnishJob>(host_.device(), *loaded_, work_.scene, work_.settings);
}

/// Brings the scene on the device to what the panels say.
void Window::editScene() {
    Requests& asked = work_.requests;
    edits_wait_ |= asked.scene_changed || asked.settings_changed;
    if (busy() || !loaded_) return;
    if (work_.settings.room != staged_room_ || work_.settings.lights != staged_lights_) restage();
    const bool can_wait = !asked.dragging;
    if (edits_wait_ && refurnishNow(host_.device(), *loaded_, work_.scene, work_.settings)) {
        edits_wait_ = false;
        restart_ = true;
    }
    // programs and photons take longer than a frame: when the user has let go
    if (can_wait && (edits_wait_ || loaded_->lacks_photons)) refurnishLater();
}

void Window::applyRequests() {
    Requests& asked = work_.requests;
    if (asked.up && loaded_) setUp(*asked.up);
    editScene();
    if (asked.quit) quit_ = true;
    if (asked.cancel_job) cancelJob();
    if (asked.home) flyTo(home_);
    if (asked.save_view) saveView();
    if (asked.save_scene && loaded_) saveScene();
    if (asked.screenshot && loaded_) screenshot_wanted_ = true;
    if (asked.turntable_pictures && loaded_) startTurntable(*asked.turntable_pictures);
    std::vector<NamedView>& views = work_.scene.views;
    if (asked.go_to_view && *asked.go_to_view < views.size()) goToView(views[*asked.go_to_view]);
    if (asked.forget_view && *asked.forget_view < views.size())
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*asked.forget_view));
    const bool look_changed = asked.look_changed;
    asked = {};
    asked.look_changed = look_changed; // updatePicture's
}

} // namespace pointrt

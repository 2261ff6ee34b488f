// SPDX-License-Identifier: Apache-2.0
// Undo, saving, and questions before unsaved edits would be lost.
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "format/os/environment.h"
#include "format/os/user_folder.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/measure/path_files.h"
#include "runtime/scene/layers.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/session/bake_cache.h"
#include "runtime/util/output_file.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/edit/compare_job.h"
#include "runtime/window/edit/free_name.h"
#include "runtime/window/edit/kept_bake.h"
#include "runtime/window/edit/measure_edit.h"
#include "runtime/window/edit/outline_job.h"
#include "runtime/window/edit/picked_path.h"
#include "runtime/window/edit/recent_files.h"
#include "runtime/window/edit/shown_scene.h"
#include "runtime/window/ui/panel_numbers.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// At most this many seconds of work are lost.
constexpr double kAutosaveEvery_s = 1;

std::string nameOf(const Workspace& work) { return std::filesystem::path(work.scene.path).filename().string(); }

} // namespace

void Window::ask(Question question, std::function<void(std::size_t)> answered) {
    work_.question = std::move(question);
    on_answer_ = std::move(answered);
}

/// Runs next, which replaces the current scene, once the scene's edits are saved or discarded.
void Window::afterSaving(std::function<void()> next) {
    if (!editor_.isModified()) return next();
    enum : std::size_t { kSave, kDiscard, kCancel };
    ask({"Save the changes to " + nameOf(work_) + "?", {"Save", "Discard", "Cancel"}},
        [this, next = std::move(next)](std::size_t answer) {
            if (answer == kCancel || (answer == kSave && !saveScene())) return;
            next();
        });
}

/// Quits at once, or asks first if pictures are being rendered, which would be lost.
void Window::quitAfterPictures() {
    if (work_.stills.empty() && !jobs_.has(JobKind::kTurntable)) {
        quit_ = true;
        return;
    }
    ask({"Pictures are still being rendered.", {"Quit without them", "Cancel"}},
        [this](std::size_t answer) { quit_ = answer == 0; });
}

void Window::openFiles(const std::vector<std::string>& paths) {
    if (!paths.empty()) afterSaving([this, paths] { opener_.drop(paths); });
}

/// Opens the desktop's file dialog. Without one, and in replays, opens the window's own browser.
void Window::chooseFiles() {
    std::error_code ignored;
    const fs::path shown = fs::absolute(work_.scene.path.empty() ? "x" : work_.scene.path, ignored);
    const std::string folder = shown.parent_path().string();
    const std::vector<std::string> command =
        dialogCommand(folder, environmentVariable("PATH"), environmentVariable("XDG_CURRENT_DESKTOP"));
    if (session_.isReplaying() || command.empty()) {
        work_.browser = browse(folder);
        return;
    }
    try {
        if (!dialog_) dialog_ = std::make_unique<FileDialog>(command);
    } catch (const std::system_error&) {
        work_.browser = browse(folder);
    }
}

void Window::handleChoice(const Requests& requests) {
    if (requests.open) chooseFiles();
    if (requests.browse) work_.browser = browse(*requests.browse);
    if (!requests.open_files.empty()) {
        work_.browser.reset();
        openFiles(requests.open_files);
    }
    if (requests.open_recent && *requests.open_recent < work_.recent_files.size())
        openFiles({work_.recent_files[*requests.open_recent]});
    if (!dialog_) return;
    if (const auto chosen = dialog_->result()) {
        dialog_.reset();
        openFiles(*chosen);
    }
}

void Window::handleEdits(const Requests& requests) {
    handleChoice(requests);
    if (requests.answer && work_.question) {
        work_.question.reset();
        std::exchange(on_answer_, {})(*requests.answer);
    }
    if (requests.save_scene && loaded_) saveScene();
    if (requests.keep_measurement && loaded_ && !keepMeasurement(work_)) notify("pick two points to measure", false);
    if (requests.save_measurement && work_.picks.size() > 1) tryOrNotify("", [&] { saveMeasurement(); });
    const Vec3 up_before = work_.scene_up;
    if (requests.undo && loaded_ && !editor_.undo()) notify("nothing to undo", false);
    if (requests.redo && loaded_ && !editor_.redo()) notify("nothing to redo", false);
    if (work_.scene_up == up_before) return;
    view_.stop();
    view_.home = work_.camera;
}

/// Writes the scene file. Returns false, after a notice with the reason, if that fails.
bool Window::saveScene() {
    if (shows_quick_bake_ && jobs_.has(JobKind::kBake)) {
        notify("wait until " + nameOf(work_) + " is baked", true); // the file would have only a tenth of the points
        return false;
    }
    bool saved = false;
    tryOrNotify("", [&] {
        const std::string path = freeName(work_.scene.path, {".toml"}) + ".toml";
        SceneDescription shown = sceneAsShown(work_, {host_.pixels().width, host_.pixels().height});
        keepBakes(shown, userBakeCache());
        writeSceneFile(path, shown);
        editor_.markSaved();
        notify("saved " + path + "; render it with pointrt-view " + path + " -o picture.png", false);
        saved = true;
    });
    return saved;
}

void Window::saveMeasurement() {
    MeasuredPath path = pickedPath(work_.picks, work_.scene_up);
    path.decimals = decimalsFor(measuredSize(length(work_.scene_max - work_.scene_min)));
    const std::string name = freeName(work_.scene.path, {".csv", ".geojson", ".dxf"});
    const std::pair<const char*, std::string> files[] = {
        {".csv", pathCsv(path)}, {".geojson", pathGeoJson(path)}, {".dxf", pathDxf(path)}};
    for (const auto& [suffix, text] : files)
        writeFile(name + suffix, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    notify("saved " + name + ".csv, " + name + ".geojson and " + name + ".dxf", false);
}

void Window::autosave() {
    if (!autosave_ || !loaded_ || work_.requests.dragging || editor_.revision() == autosaved_revision_) return;
    if (session_.now() - autosaved_s_ < kAutosaveEvery_s) return;
    autosaved_s_ = session_.now();
    autosaved_revision_ = editor_.revision();
    tryOrNotify("the edits cannot be saved for recovery after a crash: ", [&] {
        if (editor_.isModified())
            autosave_->write(sceneAsShown(work_, {host_.pixels().width, host_.pixels().height}));
        else
            autosave_->discard();
    });
}

/// Offers the edits of scene that a program left when it crashed.
void Window::offerAutosave(const SceneSource& scene) {
    autosaved_revision_ = editor_.revision();
    const std::string folder = userStateFolder();
    const auto takeAutosave = [&] {
        autosave_ = std::make_unique<Autosave>(folder.empty() ? folder : folder + "/autosave", scene.name());
    };
    if (scene.is_autosave) {
        if (!autosave_) takeAutosave(); // a new window, after the device was lost
        if (!scene.only_view) editor_.markUnsaved();
        return;
    }
    if (scene.follows_quick) return; // the edits were offered with the quick bake
    if (autosave_) autosave_->discard();
    addRecentFile(folder, scene.name());
    takeAutosave();
    if (autosave_->left().empty()) return;
    ask({"pointrt ended before the changes to " + nameOf(work_) + " were saved.", {"Discard them", "Restore them"}},
        [this, scene](std::size_t answer) {
            if (answer == 0)
                autosave_->discard();
            else
                opener_.open({autosave_->left(), scene.name(), true});
        });
}

void Window::saveOutline(std::size_t clip) {
    const auto* plane = std::get_if<ClipPlane>(&work_.scene.clips.at(clip).form);
    const std::optional<std::string> option = plane ? planeOption(*plane) : std::nullopt;
    if (!option) return notify("outlines can only be drawn in planes perpendicular to an axis", true);
    const std::string name = freeName(work_.scene.path, {".dxf", ".svg"});
    const bool starts = jobs_.start(JobKind::kStudy, [&] {
        return startedJob<OutlineJob>(
            std::make_unique<OutlineJob>(work_.scene, *option, name, options_.device),
            [this, name](OutlineJob&) { notify("saved " + name + ".dxf and " + name + ".svg", false); });
    });
    if (!starts) notify("wait until the other outline or comparison is finished", true);
}

void Window::compareScans(const Comparison& comparison) {
    const bool starts = jobs_.start(JobKind::kStudy, [&] {
        return startedJob<CompareJob>(std::make_unique<CompareJob>(work_.scene, comparison, options_.device),
                                      [this, comparison, scene = work_.scene.path](CompareJob& job) {
                                          const bool is_same = work_.scene.path == scene &&
                                                               comparison.compared < work_.scene.instances.size();
                                          if (is_same) showComparison(job.output(), comparison);
                                      });
    });
    if (!starts) notify("wait until the other outline or comparison is finished", true);
}

/// Reopens the scene with the copy of the scan that has distances, coloured by distance. Hides the reference, which
/// would cover half of the copy.
void Window::showComparison(const std::string& with_distances, const Comparison& comparison) {
    SceneDescription shown = sceneAsShown(work_, {host_.pixels().width, host_.pixels().height});
    InstanceDescription& compared = shown.instances.at(comparison.compared);
    compared.layer.name = layerName(shown, {LayerKind::kScan, comparison.compared}); // the layer keeps its name
    compared.path = with_distances;
    shown.instances.at(comparison.reference).visible = false;
    shown.render.color_by = kDistance;
    shown.render.color_map.reset();
    shown.render.color_range.reset();
    if (!autosave_ || autosave_->path().empty())
        return notify("cannot show the comparison: there is no folder in which to keep the edits", true);
    autosave_->write(shown);
    kept_view_ = KeptView{work_.scene.path, work_.camera, view_.home};
    opener_.open({autosave_->path(), work_.scene.path, true});
}

ReopenedWindow Window::handOver() {
    const bool saves_pictures = image_.isFilmRequested() || jobs_.has(JobKind::kSave) || jobs_.has(JobKind::kTurntable);
    ReopenedWindow next{std::move(session_), {}, {}, saves_pictures};
    next.session.waitForPicture();
    if (!loaded_ || !autosave_ || autosave_->path().empty() || shows_quick_bake_) return next;
    autosave_->write(sceneAsShown(work_, {host_.pixels().width, host_.pixels().height}));
    next.scene = SceneSource{autosave_->path(), work_.scene.path, true};
    next.scene->only_view = !editor_.isModified();
    next.view = KeptView{work_.scene.path, work_.camera, view_.home};
    return next;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/scene_editor.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <utility>

#include "runtime/scene/added_surroundings.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/framing.h"
#include "runtime/scene/render_setting_table.h"
#include "runtime/session/settings.h"

namespace pointrt {
namespace {

/// Removes unused materials at the end of the list, left by a former room.
void dropUnused(SceneDescription& scene, std::size_t fewest) {
    while (scene.materials.size() > fewest &&
           !usesMaterial(scene, static_cast<std::uint32_t>(scene.materials.size() - 1)))
        scene.materials.pop_back();
}

/// Takes the surroundings out of a saved scene, so that the window shows the room and lamps that were chosen for it.
void takeOutSurroundings(OpenedScene& opened) {
    const std::optional<AddedSurroundings> added = opened.file_scene.surroundings;
    if (!added) return;
    removeSurroundings(opened.file_scene);
    opened.settings.room = added->room;
    opened.settings.lights = added->lamps;
}

bool wantsFilter(const OpenedScene& scene) {
    const DenoiseChoice choice = scene.settings.denoise;
    return choice == DenoiseChoice::kOn ||
           (choice == DenoiseChoice::kAuto && isNoisy(scene.settings, scene.resolved, scene.subject));
}

} // namespace

ViewCamera SceneEditor::open(OpenedScene opened, std::uint32_t samples) {
    opened_ = std::move(opened);
    takeOutSurroundings(*opened_);
    const OpenedScene& scene = *opened_;
    const Vec3 size = scene.bounds_max - scene.bounds_min, centre = 0.5 * (scene.bounds_min + scene.bounds_max);
    work_.scene = scene.resolved;
    work_.settings = scene.settings;
    work_.scene_min = scene.bounds_min;
    work_.scene_max = scene.bounds_max;
    work_.scene_up = sceneUp(scene.resolved, scene.settings);
    work_.title = std::filesystem::path(scene.resolved.path).filename().string();
    const std::filesystem::path folder = std::filesystem::path(scene.resolved.path).parent_path();
    work_.turntable_path = (folder / "turntable" / "%04d.png").string();
    work_.picks.clear();
    work_.camera = viewOf(scene.camera, scene.settings.camera.target.value_or(centre), scene.bounds_min,
                          scene.bounds_max, work_.scene_up);
    if (scene.pivot && scene.pivot_offset != 0) work_.camera = withPivotOffset(work_.camera, scene.pivot_offset);
    work_.look = {SHOWN_BEAUTY, scene.settings.exposure, 4 * length(size), scene.scale};
    work_.target_samples = samples;
    work_.denoise = wantsFilter(scene);
    work_.only_gaussians = scene.subject.only_gaussians;
    work_.question.reset();
    work_.scan_in_view = true;
    room_lights_.clear();
    current_room_ = scene.settings.room;
    current_light_count_ = scene.settings.lights;
    pending_edits_ = false;
    history_.open(state());
    return work_.camera;
}

ViewCamera SceneEditor::refine(OpenedScene opened, std::uint32_t samples, const ViewCamera& home) {
    const bool modified = isModified(), has_moved = cameraOf(work_.camera) != cameraOf(home);
    const EditState edits = state();
    const ViewCamera view = work_.camera;
    const ViewCamera new_home = open(std::move(opened), samples);
    if (has_moved) work_.camera = view;
    if (!modified) return new_home;
    const std::vector<InstanceDescription> instances = work_.scene.instances;
    restore(&edits);
    for (std::size_t i = 0; i < instances.size(); ++i) work_.scene.instances.at(i).path = instances[i].path;
    opened_->resolved.instances = work_.scene.instances;
    noteEdits();
    return new_home;
}

bool EditState::operator==(const EditState& other) const {
    return scene == other.scene && choicesOf(settings) == choicesOf(other.settings) && exposure == other.exposure &&
           denoise == other.denoise && target_samples == other.target_samples && scene_up == other.scene_up;
}

EditState SceneEditor::state() const {
    const OpenedScene& scene = *opened_;
    return {work_.scene,
            work_.settings,
            work_.look.exposure,
            work_.denoise,
            work_.target_samples,
            work_.scene_up,
            {scene.resolved, scene.file_scene.up, scene.camera, scene.resolved_for_eye, scene.subject, current_room_,
             current_light_count_, room_lights_}};
}

bool SceneEditor::restore(const EditState* state) {
    if (!state) return false;
    work_.scene = state->scene;
    work_.settings = state->settings;
    work_.look.exposure = state->exposure;
    work_.denoise = state->denoise;
    work_.target_samples = state->target_samples;
    const Surroundings& surroundings = state->surroundings;
    if (work_.scene_up != state->scene_up) { // keeping the camera would tilt the view
        const Vec3 centre = 0.5 * (work_.scene_min + work_.scene_max);
        work_.camera = viewOf(surroundings.camera, centre, work_.scene_min, work_.scene_max, state->scene_up);
    }
    work_.scene_up = state->scene_up;
    opened_->resolved = surroundings.resolved;
    opened_->file_scene.up = surroundings.up;
    opened_->camera = surroundings.camera;
    opened_->resolved_for_eye = surroundings.resolved_for_eye;
    opened_->subject = surroundings.subject;
    current_room_ = surroundings.room;
    current_light_count_ = surroundings.light_count;
    room_lights_ = surroundings.room_lights;
    work_.requests.look_changed = pending_edits_ = true;
    ++revision_;
    return true;
}

void SceneEditor::noteEdits() {
    if (opened_ && history_.note(state())) ++revision_;
    work_.can_undo = history_.canUndo();
    work_.can_redo = history_.canRedo();
}

bool SceneEditor::undo() {
    noteEdits(); // edits in progress are undone first
    return restore(history_.undo());
}

bool SceneEditor::redo() { return restore(history_.redo()); }

void SceneEditor::markSaved() {
    noteEdits();
    history_.markSaved();
}

bool SceneEditor::isModified() const { return opened_ && history_.isModified(state()); }

bool SceneEditor::seesScans(const ViewCamera& view, ViewSize size) const {
    if (!opened_ || opened_->sample.splats.empty()) return true;
    const std::vector<SampledSplat>& splats = opened_->sample.splats;
    // each sampled splat represents a piece of surface about this wide
    const double reach = length(work_.scene_max - work_.scene_min) / std::sqrt(static_cast<double>(splats.size()));
    const double pixels_at_1 = size.height / 2 / std::tan(view.fov_deg / 2 * std::numbers::pi / 180);
    return std::any_of(splats.begin(), splats.end(), [&](const SampledSplat& splat) {
        if (view.ortho_height == 0 && length(splat.position - view.eye) < reach) return true;
        const auto at = projected(view, size, splat.position);
        if (!at) return false;
        const double margin =
            reach * (view.ortho_height > 0 ? size.height / view.ortho_height : pixels_at_1 / at->depth);
        return at->x > -margin && at->x < size.width + margin && at->y > -margin && at->y < size.height + margin;
    });
}

void SceneEditor::storeRoomLights() {
    if (work_.scene.lights == opened_->resolved.lights && work_.scene.sky == opened_->resolved.sky) return;
    std::erase_if(room_lights_, [&](const RoomLights& each) { return each.room == current_room_; });
    room_lights_.push_back({current_room_, work_.scene.lights, work_.scene.sky});
}

void SceneEditor::updateSurroundings() {
    if (work_.settings.room != current_room_ || work_.settings.lights != current_light_count_) rebuildSurroundings();
}

void SceneEditor::rebuildSurroundings() {
    // the automatic choice does not denoise hard lights, because that would blur mirror images
    const bool by_rule = work_.settings.denoise == DenoiseChoice::kAuto &&
                         work_.denoise == isNoisy(work_.settings, opened_->resolved, opened_->subject);
    storeRoomLights();
    if (work_.settings.lights != current_light_count_) // the stored lights are for another number of lamps
        std::erase_if(room_lights_, [&](const RoomLights& each) { return each.room == work_.settings.room; });
    current_room_ = work_.settings.room;
    current_light_count_ = work_.settings.lights;
    SceneDescription scene = opened_->file_scene;
    const std::size_t fewest = scene.materials.size();
    scene.materials = work_.scene.materials;
    scene.instances = work_.scene.instances;
    scene.views = work_.scene.views;
    scene.clips = work_.scene.clips;
    scene.filters = work_.scene.filters;
    scene.measures = work_.scene.measures;
    scene.shapes.clear();
    std::copy_if(work_.scene.shapes.begin(), work_.scene.shapes.end(), std::back_inserter(scene.shapes),
                 [](const ShapeDescription& shape) { return !shape.of_surroundings; });
    if (hasFileLights()) {
        scene.lights = work_.scene.lights;
        scene.sky = work_.scene.sky;
    }
    Camera camera = opened_->camera;
    camera.eye = opened_->resolved_for_eye;
    dropUnused(scene, fewest);
    addSurroundings(scene, work_.settings, camera, work_.scene_min, work_.scene_max, opened_->subject);
    work_.scene = opened_->resolved = std::move(scene);
    for (const RoomLights& each : room_lights_)
        if (!hasFileLights() && each.room == work_.settings.room) {
            work_.scene.lights = each.lights;
            work_.scene.sky = each.sky;
        }
    if (by_rule) work_.denoise = isNoisy(work_.settings, work_.scene, opened_->subject);
}

void SceneEditor::setUp(Vec3 up, ViewCamera& home, double aspect) {
    const Vec3 centre = 0.5 * (work_.scene_min + work_.scene_max);
    CameraRequest request = requestOf(home);
    request.eye = centre + length(home.eye - centre) * frontSide(up);
    request.target = centre;
    request.up = up;
    double pivot_offset = 0;
    if (!opened_->sample.splats.empty()) { // frames the scene again, with home's lens
        request.eye.reset();
        request.target.reset();
        request.ortho_height.reset();
        const FramedRequest framed = frameScene(request, opened_->sample, up, {aspect, opened_->free_share}, true);
        request = framed.camera;
        pivot_offset = framed.aside;
        opened_->subject.around_eye = framed.within;
        opened_->subject.walls = framed.walls;
        opened_->subject.lowest = lowestIfTilted(opened_->sample, up);
    }
    home = withPivotOffset(framedView(request, work_.scene_min, work_.scene_max, up, aspect), pivot_offset);
    opened_->file_scene.up = work_.scene_up = up;
    opened_->resolved_for_eye = cameraOf(home).eye;
    opened_->camera = cameraOf(home);
    opened_->resolved = work_.scene; // edited lights are discarded
    room_lights_.clear();
    rebuildSurroundings();
    pending_edits_ = true;
}

} // namespace pointrt

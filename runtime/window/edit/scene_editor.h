// SPDX-License-Identifier: Apache-2.0
// The edited scene and its surroundings (room, floor, lamps).
#pragma once

#include <optional>
#include <vector>

#include "runtime/scene/default_lighting.h"
#include "runtime/scene/scene_sample.h"
#include "runtime/window/edit/edit_history.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// A scene as opened.
struct OpenedScene {
    SceneDescription file_scene; ///< as in its file
    SceneDescription resolved;   ///< with surroundings
    RenderSettings settings;
    Camera camera;               ///< initial
    Vec3 resolved_for_eye;       ///< eye that the surroundings were made for, world frame
    Vec3 bounds_min, bounds_max; ///< of the scans, input coordinates
    SceneSample sample;          ///< of the scans
    StudioSubject subject;
    std::optional<Vec3> pivot; ///< centre that the camera was framed on; none if it was not framed automatically
    double pivot_offset = 0;   ///< see ViewCamera
    double free_share = 1;     ///< share of the picture's width, from the left, that no panel covers
    double scale = 1;          ///< input units per render unit
};

/// The user's lights in a room, to restore them later.
struct RoomLights {
    std::optional<Room> room;
    std::vector<LightDescription> lights;
    std::optional<SkyDescription> sky;
};

/// The inputs from which the surroundings were made.
struct Surroundings {
    SceneDescription resolved; ///< the scene after the last rebuild of the surroundings
    std::optional<Vec3> up;
    Camera camera;
    Vec3 resolved_for_eye;
    StudioSubject subject;
    std::optional<Room> room;
    std::optional<std::uint32_t> light_count;
    std::vector<RoomLights> room_lights;
};

/// The state that undo restores. Compares only what the user edits.
struct EditState {
    SceneDescription scene;
    RenderSettings settings;
    float exposure = 0;
    bool denoise = false;
    std::uint32_t target_samples = 0;
    Vec3 scene_up;
    Surroundings surroundings;
    bool operator==(const EditState& other) const;
};

/// Makes the edits that change several values of the workspace (panels set single values themselves), and tracks
/// whether the device has all edits.
class SceneEditor {
public:
    /// work must outlive it.
    explicit SceneEditor(Workspace& work) : work_(work) {}

    /// Replaces the scene in the workspace, with its initial view and look, and clears the edit history. samples:
    /// target per pixel. Returns the initial view.
    ViewCamera open(OpenedScene opened, std::uint32_t samples);
    bool isOpen() const { return opened_.has_value(); }

    /// Records the edits requested in a frame.
    void noteRequests(const Requests& requests) {
        pending_edits_ = pending_edits_ || requests.scene_changed || requests.settings_changed;
    }
    /// True if the device does not have the edits yet.
    bool hasPendingEdits() const { return pending_edits_; }
    void clearPendingEdits() { pending_edits_ = false; }

    /// Rebuilds the surroundings if the room or number of lamps in the settings has changed. Restores the user's last
    /// lights for that room. Lights from a scene file are used in every room.
    void updateSurroundings();
    /// Changes the up axis: resets the surroundings, and frames the scene again for home. aspect: of the picture, width
    /// over height.
    void setUp(Vec3 up, ViewCamera& home, double aspect);

    /// Records the edits since the last call as one step to undo. Call it after updateSurroundings, while no edit is in
    /// progress.
    void noteEdits();
    /// False if there is nothing to undo or redo.
    bool undo();
    bool redo();
    /// Marks the current edits as saved.
    void markSaved();
    /// Marks the opened scene as unsaved, because no file of the user holds it.
    void markUnsaved() { history_.markUnsaved(); }
    bool isModified() const;
    /// Changes with each edit.
    std::uint64_t revision() const { return revision_; }

    /// As open, for a finer bake of the same scan. Keeps the edits, and the view unless it is still the former scene's
    /// initial view.
    ViewCamera refine(OpenedScene opened, std::uint32_t samples, const ViewCamera& home);

    /// Whether view shows any of the scans, judged by their sample with a margin: false only if it shows none.
    bool seesScans(const ViewCamera& view, ViewSize size) const;

private:
    EditState state() const;
    bool restore(const EditState* state);
    void rebuildSurroundings();
    void storeRoomLights();
    bool hasFileLights() const { return !opened_->file_scene.lights.empty() || opened_->file_scene.sky; }

    Workspace& work_;
    std::optional<OpenedScene> opened_; ///< opened_->resolved: the scene after the last rebuild of the surroundings
    std::optional<Room> current_room_;
    std::optional<std::uint32_t> current_light_count_;
    std::vector<RoomLights> room_lights_;
    EditHistory<EditState> history_;
    std::uint64_t revision_ = 0;
    bool pending_edits_ = false;
};

} // namespace pointrt

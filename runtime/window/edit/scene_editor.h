// SPDX-License-Identifier: Apache-2.0
// The scene as the panels edit it, and what stands around it.
#pragma once

#include <optional>
#include <vector>

#include "runtime/scene/default_lighting.h"
#include "runtime/scene/scene_sample.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// A scene as it was opened.
struct OpenedScene {
    SceneDescription file_scene; ///< as its file has it
    SceneDescription resolved;   ///< with its surroundings
    RenderSettings settings;
    Camera camera;               ///< the first
    Vec3 resolved_for_eye;       ///< the eye that its surroundings were put up for, world frame
    Vec3 bounds_min, bounds_max; ///< of the scan, input coordinates
    SceneSample sample;          ///< of its scans
    StudioSubject subject;
    std::optional<Vec3> pivot; ///< what the camera was framed for; none: it was not framed
    double pivot_offset = 0;   ///< of the camera, as ViewCamera has it
    double free_share = 1;     ///< of the picture's width, from the left: no panel covers it
    double scale = 1;          ///< input units in a render unit
};

/// Edits a workspace's scene, settings and denoise where that takes more than writing a number, which panels do
/// themselves. Knows which of all that is on the device.
class SceneEditor {
public:
    /// work must outlive it.
    explicit SceneEditor(Workspace& work) : work_(work) {}

    /// Puts the scene in the workspace, with the view and look that it begins with, in place of the one there was.
    /// samples: a pixel, at which its picture is done.
    void open(OpenedScene opened, std::uint32_t samples);
    bool isOpen() const { return opened_.has_value(); }

    /// Takes note of what was asked for in a frame.
    void noteRequests(const Requests& requests) {
        pending_edits_ = pending_edits_ || requests.scene_changed || requests.settings_changed;
    }
    /// True where edits are not yet on the device.
    bool hasPendingEdits() const { return pending_edits_; }
    void clearPendingEdits() { pending_edits_ = false; }

    /// Where the settings ask for another room, or another number of its lamps, than stands there: puts it up in place
    /// of that, with the lamps that the user had in it last. A scene file's own are in every room.
    void updateSurroundings();
    /// Puts the scan on another side: what stands around it begins anew, for the view that home becomes. aspect: of
    /// the picture, width over height.
    void setUp(Vec3 up, ViewCamera& home, double aspect);

private:
    /// What the user made of a room's lamps, to find it again.
    struct RoomLights {
        std::optional<Room> room;
        std::vector<LightDescription> lights;
        std::optional<SkyDescription> sky;
    };

    void rebuildSurroundings();
    void storeRoomLights();
    bool hasFileLights() const { return !opened_->file_scene.lights.empty() || opened_->file_scene.sky; }

    Workspace& work_;
    std::optional<OpenedScene> opened_; ///< staged: when its surroundings were put up last
    std::optional<Room> current_room_;
    std::optional<std::uint32_t> current_light_count_;
    std::vector<RoomLights> room_lights_;
    bool pending_edits_ = false;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Default surroundings of a scan: a room, lights, or a small studio.
#pragma once

#include <optional>

#include "runtime/scene/background.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"
#include "runtime/scene/visibility.h"

namespace pointrt {

/// Default number of lights on the ring.
constexpr std::uint32_t kRingLights = 3;

/// The properties of the scans that the studio adapts to.
struct StudioSubject {
    /// The 95th percentile of reflectance; for an eye within the scene, the mean of what the eye sees. Lamps are dimmed
    /// for white subjects and brightened for black ones; the floor looks the same with every subject.
    double reflectance = 0.5;
    /// The eye is inside the scene, where lamps outside would be occluded: so one lamp is near the eye, and ambient
    /// light comes from all sides.
    bool around_eye = false;
    /// Every instance is a Gaussian capture that shows its captured light and is not lit.
    bool only_gaussians = false;
    /// The walls around the eye, if any enclose it.
    std::optional<Surrounding> walls = {};
    /// The mean reflectance: lamps are brightened for mostly dark subjects until their brightest parts are white.
    double mean_reflectance = 0.5;
    /// Light bounces: paths see the sky, and the floor lights the scans.
    bool is_path_traced = false;
    /// Open ground, which would seem to hover over a floor. With path tracing it also gets a light sky below.
    bool is_ground = false;
    /// The lowest point along up. Needed if the scene's up is not along an axis: the corner of its box is then far
    /// below.
    std::optional<double> lowest = {};
};

/// Whether addSurroundings chooses the lights, because neither scene nor settings do.
bool isLitByDefault(const SceneDescription& scene, const RenderSettings& settings);

/// Adds default surroundings to scene:
///  - the room of settings or scene, a box that encloses the bounds and the eye;
///  - if the scene has no lights and no sky, settings.lights point lights on a ring above the bounds (default
///    kRingLights);
///  - if neither room nor lights are set and the scene has no lights, shapes or sky: instead a studio of three soft
///    lamps over a matte floor, which is a backdrop without first hits and coverage. Gaussian captures alone get a
///    black background instead.
///  - settings.background: a sky of that colour in place of the scene's. Unlit scenes then get the studio's lamps
///    without its floor; with only_gaussians they get no lamps unless settings.lights or a room adds them.
/// Stores the chosen room and number of lamps in scene.surroundings, unless a choice is already there.
/// The surroundings are placed for the eye scene.staged_for, else for camera's eye, and do not follow the eye.
/// low and high: corners of the scene's bounds, world frame.
void addSurroundings(SceneDescription& scene, const RenderSettings& settings, const Camera& camera, Vec3 low, Vec3 high,
                     const StudioSubject& subject = {});

/// The plain background of a scene's pictures, which then get no highlight compression. None if the scene has no plain
/// background, or if its sky has been edited since. scene: with surroundings
std::optional<Background> pictureBackground(const SceneDescription& scene);

/// Makes the surroundings from addSurroundings a part of the scene, so that none are added again later. For scenes that
/// will be edited or saved.
void ownSurroundings(SceneDescription& scene, RenderSettings& settings);

/// The up direction of rooms and the sky, unit length: the scene's, or the axis nearest to the camera's up.
Vec3 sceneUp(const SceneDescription& scene, const RenderSettings& settings);

} // namespace pointrt

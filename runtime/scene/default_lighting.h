// SPDX-License-Identifier: Apache-2.0
// What stands around a scan when the scene says nothing: a room, lights, or a small studio.
#pragma once

#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Lights on the ring where nobody says how many.
constexpr std::uint32_t kRingLights = 3;

/// What the studio is set up for.
struct StudioSubject {
    /// Reflectance that only a twentieth of the scans is brighter than. Lamps are dimmed for white, and opened for
    /// black ones; the floor looks the same under all.
    double reflectance = 0.5;
    /// The eye stands amidst it, where lamps outside do not reach: one stands by the eye, and light comes from all
    /// sides.
    bool around_eye = false;
};

/// Adds to scene, where it has none of its own:
///  - the room that settings or scene ask for, as a box that carries the bounds and holds the eye;
///  - settings.lights point lights on a ring above the bounds (kRingLights with a room or with room none, where not
///  given);
///  - where nothing at all is said of room and lights: a studio of three soft lamps over a matte floor, which is a
///    backdrop: no first hit, no coverage.
/// They are put up for scene.staged_for, else for the eye of camera, and stay where they are when it moves.
/// low and high: corners of the scene's bounds, world frame.
void addSurroundings(SceneDescription& scene, const RenderSettings& settings, const Camera& camera, Vec3 low, Vec3 high,
                     const StudioSubject& subject = {});

/// Makes what addSurroundings has added to scene the scene's own, for one that edits or saves it as it is: from now on
/// nothing more is added.
void ownSurroundings(SceneDescription& scene, RenderSettings& settings);

/// The unit vector that rooms and the sky stand on: the scene's, or the axis nearest to the camera's up.
Vec3 sceneUp(const SceneDescription& scene, const RenderSettings& settings);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The window's turntable camera: an eye that looks at a pivot, without roll.
#pragma once

#include <optional>

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Size of the picture in window units, above 0. Cursor positions are from its upper left corner, y down.
struct ViewSize {
    double width = 1, height = 1;
};

/// Points and lengths in input coordinates. The functions below keep the eye within frameCamera's limits and the
/// horizon level (no roll about the up axis). Non-finite arguments leave the view unchanged.
struct ViewCamera {
    Vec3 eye{0, 0, 1}, pivot; ///< never equal
    Vec3 up{0, 1, 0};         ///< turntable axis, any length but zero
    Vec3 heading{0, 0, -1};   ///< up direction of the picture when looking along the axis; any length but zero
    double fov_deg = 40;      ///< vertical; kept while orthographic
    double ortho_height = 0;  ///< height of the picture at the pivot; 0: perspective
    /// Shifts the true eye and target to the right by this fraction of the picture's height, so that the pivot appears
    /// left of centre, in the part that no panel covers.
    double pivot_offset = 0;
    Vec3 scene_centre;       ///< of the bounding sphere
    Vec3 scene_half;         ///< half the edges of the scene's bounds
    double scene_radius = 1; ///< above 0
};

/// Orthonormal; right x up = -forward.
struct ViewAxes {
    Vec3 right, up, forward;
};

/// A projected point, in window units.
struct ViewPoint {
    double x = 0, y = 0;
    double depth = 0; ///< from the eye along the view direction, above 0
};

/// camera as a ViewCamera in a scene with these bounds. The pivot is target if target is on the line of sight. up: of
/// the scene or the user; replaced by camera's own up if camera is rolled relative to it.
ViewCamera viewOf(const Camera& camera, Vec3 target, Vec3 bounds_min, Vec3 bounds_max, Vec3 up);

/// The view of frameCamera(request): the initial view and Home. scene_up: used if request has no up. Throws as
/// frameCamera does.
ViewCamera framedView(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, Vec3 scene_up, double aspect);

Camera cameraOf(const ViewCamera& view);
/// The request from which frameCamera computes cameraOf(view): for scene files and the command line.
CameraRequest requestOf(const ViewCamera& view);

ViewAxes axesOf(const ViewCamera& view);
double distanceToPivot(const ViewCamera& view);
/// Height of the view at the pivot's depth.
double heightAtPivot(const ViewCamera& view);

/// The point under the cursor in the plane through the pivot that faces the eye.
Vec3 pointAtPivotDepth(const ViewCamera& view, ViewSize size, double x, double y);
/// None if point is beside or behind the eye.
std::optional<ViewPoint> projected(const ViewCamera& view, ViewSize size, Vec3 point);

/// Orbits about the pivot by a drag of (dx, dy) window units: half a turn per picture height. Stops 0.1 degrees short
/// of straight up and straight down.
ViewCamera orbited(const ViewCamera& view, ViewSize size, double dx, double dy);

/// Pans so that points at the pivot's depth follow the cursor.
ViewCamera panned(const ViewCamera& view, ViewSize size, double dx, double dy);

/// Zooms to the cursor: four steps halve the distance to the pivot (or the height of an orthographic view), and the
/// point under the cursor at the pivot's depth stays in place. The distance stays within 1e-4 to 1e3 scene radii.
ViewCamera zoomed(const ViewCamera& view, ViewSize size, double steps, double x, double y);

/// Flies in direction (x right, y along the axis, z forward; each -1 to 1) for seconds, at the pivot's distance per
/// second, at most half a scene radius. Orthographic views zoom instead of moving forward.
ViewCamera flown(const ViewCamera& view, Vec3 direction, double seconds);

/// Turns the view about the eye, a quarter turn per picture height.
ViewCamera looked(const ViewCamera& view, ViewSize size, double dx, double dy);

/// Moves the pivot to point, which moves to the centre of the picture and keeps its size.
ViewCamera centredOn(const ViewCamera& view, Vec3 point);

/// view with another pivot_offset and the same picture.
ViewCamera withPivotOffset(const ViewCamera& view, double pivot_offset);

/// Looks at the pivot from a standard side. kSensor leaves the view unchanged. Front is +Z, or -Y if the up axis is
/// along Z.
ViewCamera standardView(const ViewCamera& view, StandardView which);
/// view moved back or closer until the scene fills the part of the picture that no panel covers. A view that shows less
/// than half of the scene, or has another pivot, shows a detail and stays unchanged.
ViewCamera fittedView(const ViewCamera& view, ViewSize size);
/// Looks at the pivot from the opposite side.
ViewCamera oppositeView(const ViewCamera& view);

/// Switches between perspective and orthographic; objects at the pivot keep their size. An orthographic eye is outside
/// the scene.
ViewCamera orthoToggled(const ViewCamera& view);

/// Sets the field of view, 1 to 170. keep_size: moves the eye so that objects at the pivot keep their size.
ViewCamera withFov(const ViewCamera& view, double fov_deg, bool keep_size);

} // namespace pointrt

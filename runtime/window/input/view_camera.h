// SPDX-License-Identifier: Apache-2.0
// The camera as users handle it: an eye that looks at a pivot, level with the scene.
#pragma once

#include <optional>

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Size of the picture in window units, above 0. Cursor positions count from its upper left corner, y down.
struct ViewSize {
    double width = 1, height = 1;
};

/// Points and lengths in input coordinates. The functions below leave the eye within reach of frameCamera and the
/// sides of the picture level (at right angles to the turntable's axis); a number that is not finite moves nothing.
struct ViewCamera {
    Vec3 eye{0, 0, 1}, pivot; ///< the eye looks at the pivot; never equal
    Vec3 up{0, 1, 0};         ///< axis of the turntable, of any length but zero
    Vec3 heading{0, 0, -1};   ///< up in the picture where the view goes along the axis, of any length but zero
    double fov_deg = 40;      ///< vertical; kept for later while orthographic
    double ortho_height = 0;  ///< what the picture shows in height; 0: perspective
    /// The picture's middle is so many of its heights right of the pivot, which stands in the part that no panel
    /// covers: the true eye and what it looks at are right of eye and pivot.
    double pivot_offset = 0;
    Vec3 scene_centre;       ///< of the sphere around the scene
    double scene_radius = 1; ///< above 0
};

/// Orthonormal; right x up = -forward.
struct ViewAxes {
    Vec3 right, up, forward;
};

/// Where a point lies in the picture, in window units.
struct ViewPoint {
    double x = 0, y = 0;
    double depth = 0; ///< along the view from the eye, above 0
};

/// camera in a scene of these bounds, turned about the part of target that lies on the line of sight. up: the scene's,
/// or what the user asked for; where camera is tilted against it, camera's own takes its place.
ViewCamera viewOf(const Camera& camera, Vec3 target, Vec3 bounds_min, Vec3 bounds_max, Vec3 up);

/// frameCamera's answer to request as a view: where the window begins, and Home. scene_up: up where request has none.
/// Throws what frameCamera does.
ViewCamera framedView(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, Vec3 scene_up, double aspect);

Camera cameraOf(const ViewCamera& view);
/// What gives cameraOf(view) when frameCamera completes it: for scene files and the command line.
CameraRequest requestOf(const ViewCamera& view);

ViewAxes axesOf(const ViewCamera& view);
double distanceToPivot(const ViewCamera& view);
/// Height of what the picture shows at the pivot's depth.
double heightAtPivot(const ViewCamera& view);

/// The point under the cursor in the plane through the pivot that faces the eye.
Vec3 pointAtPivotDepth(const ViewCamera& view, ViewSize size, double x, double y);
/// Nothing where point is beside or behind the eye.
std::optional<ViewPoint> projected(const ViewCamera& view, ViewSize size, Vec3 point);

/// Turns about the pivot as the cursor goes by (dx, dy) window units, half a turn for the picture's height. Ends a
/// tenth of a degree before straight up and down.
ViewCamera orbited(const ViewCamera& view, ViewSize size, double dx, double dy);

/// What lies at the pivot's depth goes with the cursor.
ViewCamera panned(const ViewCamera& view, ViewSize size, double dx, double dy);

/// Four steps halve the distance to the pivot (or the height of an orthographic picture); what is under the cursor at
/// the pivot's depth stays there. Ends at 1e-4 and 1e3 scene radii.
ViewCamera zoomed(const ViewCamera& view, ViewSize size, double steps, double x, double y);

/// Goes by direction (x right, y along the axis, z forward; each -1 to 1) for seconds, in one as far as it is to the
/// pivot, half a scene radius at most. In an orthographic view, where going forward shows nothing, it zooms.
ViewCamera flown(const ViewCamera& view, Vec3 direction, double seconds);

/// Turns the eye where it stands, the way the cursor goes, a quarter turn for the picture's height.
ViewCamera looked(const ViewCamera& view, ViewSize size, double dx, double dy);

/// point becomes the pivot and comes to the middle at the size that it has.
ViewCamera centredOn(const ViewCamera& view, Vec3 point);

/// view with its pivot so far left of the picture's middle, and nothing moved in the scene.
ViewCamera withPivotOffset(const ViewCamera& view, double pivot_offset);

/// The pivot from a side; but for kSensor, which is where the view is already. Front is +Z where the axis is not along
/// Z, and -Y where it is.
ViewCamera standardView(const ViewCamera& view, StandardView which);
/// The pivot from the other side.
ViewCamera oppositeView(const ViewCamera& view);

/// Perspective becomes orthographic and back; what is at the pivot keeps its size. Orthographic, the eye stands outside
/// of the scene.
ViewCamera orthoToggled(const ViewCamera& view);

/// fov_deg within 1 to 170; with keep_size the eye moves so that what is at the pivot keeps its size.
ViewCamera withFov(const ViewCamera& view, double fov_deg, bool keep_size);

} // namespace pointrt

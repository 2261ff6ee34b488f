// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/view_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/scene/camera.h"
#include "runtime/util/degree.h"
#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

/// Steepest elevation: closer to the poles, rounding of eye and pivot would destroy the horizontal direction. The
/// difference is invisible.
constexpr double kSteepest = (90 - 0.1) * kDegree;
/// Half of the sine at which orbiting stops: only standard views and external cameras are closer to a pole.
const double kPoleSine = std::cos(kSteepest) / 2;
/// Well above rounding, well below what is visible.
constexpr double kTiltSine = 1e-6;

constexpr double kMinRadii = 1e-4, kMaxRadii = 1e3; // distance from the pivot
/// Maximum distance of the pivot from the scene's centre. An orthographic eye can be as far again plus a radius, which
/// stays within frameCamera's 1e4.
constexpr double kReachRadii = 4e3;
/// Smallest distance relative to the coordinates: 1e5 doubles then lie between eye and pivot, for an angular resolution
/// of 1e-5.
constexpr double kMinOfCoordinate = 2e-11;

constexpr double kStepsToHalve = 4;
constexpr double kRadiiPerSecond = 0.5;
/// Limits the speed near objects: half a radius per second would be 2.5 km/s in a city of 10 km.
constexpr double kPivotsPerSecond = 1;
constexpr double kFlyStepsPerSecond = 4; // orthographic
constexpr double kStandingShare = 1e-9;  // above rounding, so that a view at rest stays bit-identical

double leastDistance(const ViewCamera& view) {
    return std::max(kMinRadii * view.scene_radius, kMinOfCoordinate * length(view.scene_centre));
}

double tangent(const ViewCamera& view) { return std::tan(verticalHalfAngle(view.fov_deg)); }

/// The distance at which a perspective view shows the same height as view.
double perspectiveDistance(const ViewCamera& view) { return heightAtPivot(view) / (2 * tangent(view)); }

bool isNearPole(Vec3 forward, Vec3 up) { return length(cross(forward, up)) < kPoleSine * length(up); }

double extent(const ViewCamera& view) {
    return std::max(length(view.eye - view.scene_centre), length(view.pivot - view.scene_centre));
}

/// Returns after; or before, if after exceeds frameCamera's limits or is NaN. Views that start outside may stay there.
ViewCamera withinReach(const ViewCamera& before, const ViewCamera& after) {
    const double limit = std::max(extent(before), kReachRadii * before.scene_radius);
    const bool eye_within = length(after.eye - after.scene_centre) <= limit;
    return eye_within && length(after.pivot - after.scene_centre) <= limit ? after : before;
}

/// Orthographic rays start at the eye. Moves the eye outside the scene, whatever the direction, but not beyond the
/// walls of a room.
ViewCamera withEyeOutside(ViewCamera view) {
    const double least = length(view.pivot - view.scene_centre) + view.scene_radius;
    const bool stands_right = std::abs(distanceToPivot(view) - least) <= kStandingShare * least;
    if (view.ortho_height > 0 && !stands_right) view.eye = view.pivot - axesOf(view).forward * least;
    return view;
}

ViewCamera translated(const ViewCamera& view, Vec3 by) {
    ViewCamera after = view;
    after.eye = view.eye + by;
    after.pivot = view.pivot + by;
    return withinReach(view, withEyeOutside(after));
}

/// attitude after a drag by these angles.
Attitude rotatedBy(const Attitude& attitude, Vec3 axis, double right_angle, double up_angle) {
    return {rotated(attitude.right, axis, -right_angle),
            std::clamp(attitude.elevation + up_angle, -kSteepest, kSteepest)};
}

/// The horizontal front direction, as in frameCamera.
Vec3 frontOf(Vec3 axis) {
    const Vec3 minus_z{0, 0, -1}, plus_y{0, 1, 0};
    const Vec3 wanted = length(cross(minus_z, axis)) < kTiltSine ? plus_y : minus_z;
    return normalize(wanted - axis * dot(wanted, axis));
}

/// The true eye and target, without pivot_offset.
ViewCamera unoffsetView(ViewCamera view) {
    if (view.pivot_offset == 0) return view; // bit-identical
    const Vec3 right = axesOf(view).right * (view.pivot_offset * heightAtPivot(view));
    view.eye = view.eye + right;
    view.pivot = view.pivot + right;
    view.pivot_offset = 0;
    return view;
}

ViewCamera withAttitude(const ViewCamera& view, const Attitude& attitude) {
    return withinReach(view, withEyeOutside(placed(view, view.pivot, distanceToPivot(view), attitude)));
}

} // namespace

ViewCamera viewOf(const Camera& camera, Vec3 target, Vec3 bounds_min, Vec3 bounds_max, Vec3 up) {
    ViewCamera view;
    view.scene_centre = bounds_min + (bounds_max - bounds_min) * 0.5;
    view.scene_half = (bounds_max - bounds_min) * 0.5;
    const double half_diagonal = length(view.scene_half);
    view.scene_radius = half_diagonal > 0 ? half_diagonal : 1; // as in frameCamera
    view.eye = camera.eye;
    const Vec3 to_target = target - camera.eye;
    const double ahead = dot(to_target, camera.forward);
    const bool on_line = length(to_target - camera.forward * ahead) <= 1e-9 * ahead; // within rounding
    const double reach = ahead > leastDistance(view) ? ahead : view.scene_radius;
    view.pivot = on_line && ahead == reach ? target : camera.eye + camera.forward * reach;
    const Vec3 axis = usableAxis(up);
    view.up = std::abs(dot(camera.right, axis)) <= kTiltSine * length(axis) ? axis : camera.up;
    view.heading = camera.up;
    view.fov_deg = camera.fov_deg;
    view.ortho_height = camera.ortho_height;
    return view;
}

ViewCamera framedView(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, Vec3 scene_up, double aspect) {
    CameraRequest complete = request;
    if (!complete.up) complete.up = scene_up;
    const Vec3 target = request.target.value_or(bounds_min + (bounds_max - bounds_min) * 0.5);
    return viewOf(frameCamera(complete, bounds_min, bounds_max, aspect), target, bounds_min, bounds_max, *complete.up);
}

ViewCamera withPivotOffset(const ViewCamera& view, double pivot_offset) {
    ViewCamera after = unoffsetView(view);
    const Vec3 left = axesOf(after).right * (-pivot_offset * heightAtPivot(after));
    after.eye = after.eye + left;
    after.pivot = after.pivot + left;
    after.pivot_offset = pivot_offset;
    return after;
}

Camera cameraOf(const ViewCamera& shown) {
    const ViewCamera view = unoffsetView(shown);
    const ViewAxes axes = axesOf(view);
    Camera camera;
    camera.eye = view.eye;
    camera.right = axes.right;
    camera.up = axes.up;
    camera.forward = axes.forward;
    camera.fov_deg = view.fov_deg;
    camera.ortho_height = view.ortho_height;
    return camera;
}

CameraRequest requestOf(const ViewCamera& shown) {
    const ViewCamera view = unoffsetView(shown);
    CameraRequest request;
    request.eye = view.eye;
    request.target = view.pivot;
    request.up = isNearPole(axesOf(view).forward, view.up) ? view.heading : view.up;
    request.fov_deg = view.fov_deg;
    request.ortho = view.ortho_height > 0;
    if (request.ortho) request.ortho_height = view.ortho_height;
    return request;
}

ViewAxes axesOf(const ViewCamera& view) {
    const Vec3 forward = normalize(view.pivot - view.eye);
    const Vec3 right = normalize(cross(forward, isNearPole(forward, view.up) ? view.heading : view.up));
    return {right, cross(right, forward), forward};
}

double distanceToPivot(const ViewCamera& view) { return length(view.pivot - view.eye); }

double heightAtPivot(const ViewCamera& view) {
    return view.ortho_height > 0 ? view.ortho_height : 2 * distanceToPivot(view) * tangent(view);
}

Vec3 pointAtPivotDepth(const ViewCamera& view, ViewSize size, double x, double y) {
    const ViewAxes axes = axesOf(view);
    const double unit = heightAtPivot(view) / size.height;
    return view.pivot + axes.right * ((x - size.width / 2 + view.pivot_offset * size.height) * unit) +
           axes.up * ((size.height / 2 - y) * unit);
}

std::optional<ViewPoint> projected(const ViewCamera& shown, ViewSize size, Vec3 point) {
    const ViewCamera view = unoffsetView(shown);
    const ViewAxes axes = axesOf(view);
    const Vec3 to = point - view.eye;
    const double depth = dot(to, axes.forward);
    if (!(depth > 0)) return {};
    const double height = view.ortho_height > 0 ? view.ortho_height : 2 * depth * tangent(view);
    const double units = size.height / height;
    return ViewPoint{size.width / 2 + dot(to, axes.right) * units, size.height / 2 - dot(to, axes.up) * units, depth};
}

ViewCamera orbited(const ViewCamera& view, ViewSize size, double dx, double dy) {
    const double angle = std::numbers::pi / size.height;
    return withAttitude(view, rotatedBy(attitudeOf(view), normalize(view.up), dx * angle, -dy * angle));
}

ViewCamera panned(const ViewCamera& view, ViewSize size, double dx, double dy) {
    const ViewAxes axes = axesOf(view);
    const double unit = heightAtPivot(view) / size.height;
    return translated(view, axes.right * (-dx * unit) + axes.up * (dy * unit));
}

ViewCamera zoomed(const ViewCamera& view, ViewSize size, double steps, double x, double y) {
    if (!std::isfinite(steps)) return view;
    const double distance = perspectiveDistance(view);
    // views outside the limits may stay there but not move farther out
    const double least = std::min(distance, leastDistance(view));
    const double most = std::max(distance, kMaxRadii * view.scene_radius);
    const double scale = std::clamp(distance * std::exp2(-steps / kStepsToHalve), least, most) / distance;
    const Vec3 fixed = pointAtPivotDepth(view, size, x, y);
    ViewCamera after = view;
    after.pivot = fixed + (view.pivot - fixed) * scale;
    after.eye = view.ortho_height > 0 ? view.eye + (after.pivot - view.pivot) : fixed + (view.eye - fixed) * scale;
    after.ortho_height = view.ortho_height * scale;
    return withinReach(view, withEyeOutside(after));
}

ViewCamera flown(const ViewCamera& view, Vec3 direction, double seconds) {
    const ViewAxes axes = axesOf(view);
    const double step =
        std::min(kRadiiPerSecond * view.scene_radius, kPivotsPerSecond * distanceToPivot(view)) * seconds;
    const Vec3 level = axes.right * (direction.x * step) + normalize(view.up) * (direction.y * step);
    if (view.ortho_height > 0)
        return zoomed(translated(view, level), {}, kFlyStepsPerSecond * direction.z * seconds, 0.5, 0.5);
    return translated(view, level + axes.forward * (direction.z * step));
}

ViewCamera looked(const ViewCamera& view, ViewSize size, double dx, double dy) {
    if (view.ortho_height > 0) return orbited(view, size, dx, dy);
    const double angle = std::numbers::pi / 2 / size.height, distance = distanceToPivot(view);
    const Attitude attitude = rotatedBy(attitudeOf(view), normalize(view.up), dx * angle, -dy * angle);
    const Vec3 forward = forwardOf(attitude, normalize(view.up));
    ViewCamera after = placed(view, view.eye + forward * distance, distance, attitude);
    after.eye = view.eye;
    return withinReach(view, after);
}

ViewCamera centredOn(const ViewCamera& view, Vec3 point) {
    const Vec3 forward = axesOf(view).forward;
    const double depth = dot(point - view.eye, forward);
    const bool at_depth = view.ortho_height == 0 && depth >= leastDistance(view);
    ViewCamera after = view;
    after.pivot = point;
    after.eye = point - forward * (at_depth ? depth : distanceToPivot(view));
    return withinReach(view, withEyeOutside(after));
}

ViewCamera standardView(const ViewCamera& view, StandardView which) {
    const Vec3 axis = normalize(view.up), front = frontOf(axis), right = cross(front, axis);
    switch (which) {
    case StandardView::kFront:
        return withAttitude(view, {right, 0});
    case StandardView::kBack:
        return withAttitude(view, {right * -1, 0});
    case StandardView::kRight:
        return withAttitude(view, {front, 0});
    case StandardView::kLeft:
        return withAttitude(view, {front * -1, 0});
    case StandardView::kTop:
        return withAttitude(view, {right, -90 * kDegree});
    case StandardView::kBottom:
        return withAttitude(view, {right, 90 * kDegree});
    case StandardView::kIso: // equal angles to all three axes
        return withAttitude(view, {normalize(right + front), -std::atan(std::sqrt(0.5))});
    case StandardView::kSensor:
        break;
    }
    return view;
}

ViewCamera fittedView(const ViewCamera& view, ViewSize size) {
    constexpr double kMargin = 1.1; // a twentieth on each side is for the toolbar
    const bool is_detail =
        heightAtPivot(view) < view.scene_radius || length(view.pivot - view.scene_centre) > view.scene_radius / 2;
    if (is_detail) return view;
    const ViewAxes axes = axesOf(view);
    // the pivot's offset moves the eye sideways, which shifts nearer objects farther in the picture
    const double aspect = size.width / size.height, offset = view.pivot_offset, slope = tangent(view) / kMargin;
    const double free_aspect = std::max(aspect - 2 * offset, 0.1);
    double height = 0, distance = leastDistance(view);
    for (unsigned bits = 0; bits < 8; ++bits) {
        const Vec3& half = view.scene_half;
        const Vec3 corner{bits & 1 ? half.x : -half.x, bits & 2 ? half.y : -half.y, bits & 4 ? half.z : -half.z};
        const double across = dot(corner, axes.right), upwards = std::abs(dot(corner, axes.up));
        const double ahead = dot(corner, axes.forward);
        height = std::max({height, 2 * kMargin * upwards, 2 * kMargin * std::abs(across) / free_aspect});
        distance = std::max({distance, upwards / slope - ahead, (-across / slope - aspect * ahead) / free_aspect,
                             (across / slope - (aspect - 4 * offset) * ahead) / free_aspect});
    }
    ViewCamera after = view;
    after.pivot = view.scene_centre;
    after.eye = after.pivot - axes.forward * distance;
    if (view.ortho_height > 0 && height > 0) after.ortho_height = height;
    return withinReach(view, withEyeOutside(after));
}

ViewCamera oppositeView(const ViewCamera& view) {
    const Attitude attitude = attitudeOf(view);
    return withAttitude(view, {attitude.right * -1, -attitude.elevation});
}

ViewCamera orthoToggled(const ViewCamera& view) {
    ViewCamera after = view;
    after.ortho_height = view.ortho_height > 0 ? 0 : heightAtPivot(view);
    if (view.ortho_height > 0) after.eye = view.pivot - axesOf(view).forward * perspectiveDistance(view);
    return withinReach(view, withEyeOutside(after));
}

ViewCamera withFov(const ViewCamera& view, double fov_deg, bool keep_size) {
    if (!std::isfinite(fov_deg)) return view;
    ViewCamera after = view;
    after.fov_deg = std::clamp(fov_deg, 1.0, 170.0);
    if (keep_size && view.ortho_height == 0)
        after.eye = view.pivot - axesOf(view).forward * (heightAtPivot(view) / (2 * tangent(after)));
    return withinReach(view, after);
}

} // namespace pointrt

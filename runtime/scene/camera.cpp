// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "format/base/error.h"
#include "runtime/scene/camera_range.h"
#include "runtime/scene/panorama.h"

namespace pointrt {
namespace {

// Sine of the angle below which up and view direction count as parallel: far above rounding errors, far below visible.
constexpr double kParallelSine = 1e-6;

/// The distance at which a sphere of radius just fills the narrower field of view.
double framingDistance(double radius, double fov_deg, double aspect) {
    return radius / std::sin(std::min(verticalHalfAngle(fov_deg), horizontalHalfAngle(fov_deg, aspect)));
}

/// The device stores ray distances as float: at this distance they still resolve a thousandth of the scene's radius.
constexpr double kFarthestRadii = 1e4;
/// Below this, neighbouring rays are equal as floats.
constexpr double kMinFov_deg = 1e-3;

/// Ray origins are float too: at this window height, in scene radii, a hundred rows still have distinct origins.
constexpr double kMinHeightRadii = 1e-5;

/// v scaled so that its squares neither overflow nor underflow.
Vec3 withinRange(Vec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? v * (1 / largest) : v;
}

bool isParallel(Vec3 up, Vec3 forward) { return length(cross(forward, up)) < kParallelSine * length(up); }

Vec3 usableUp(Vec3 up, Vec3 forward) {
    const Vec3 minus_z{0, 0, -1}, plus_y{0, 1, 0};
    if (!isParallel(up, forward)) return up;
    return isParallel(minus_z, forward) ? plus_y : minus_z;
}

void requireUsable(const CameraRequest& request) {
    if (!(request.fov_deg >= kMinFov_deg && request.fov_deg < 180))
        throw Error{ExitCode::kBadUsage, "--fov: must be 0.001 or more and below 180 degrees"};
    if (request.up && !(length(withinRange(*request.up)) > 0))
        throw Error{ExitCode::kBadUsage, "--up: the zero vector has no direction"};
    if (request.eye && request.target && !(length(*request.target - *request.eye) > 0))
        throw Error{ExitCode::kBadUsage, "--eye and --target: must be different points"};
}

void requireNear(const char* option, const std::optional<Vec3>& point, Vec3 low, Vec3 high) {
    if (point && !isWithinCameraRange(*point, low, high))
        throw Error{ExitCode::kBadUsage, std::string(option) + ": more than 10000 scene radii away"};
}

/// The radius of the sphere around the bounds.
double boundingRadius(Vec3 low, Vec3 high) {
    const double half_diagonal = length(high - low) / 2;
    // a scene of one splat has no extent, so any distance shows it
    return half_diagonal > 0 ? half_diagonal : 1;
}

bool isParallelProjection(const CameraRequest& request) { return request.ortho || request.ortho_height; }

/// The height of the picture in scene units; 0 for a perspective camera.
double windowHeight(const CameraRequest& request, Vec3 low, Vec3 high, double aspect) {
    if (!isParallelProjection(request)) return 0;
    if (!request.ortho_height) return framingHeight(low, high, aspect);
    const double radius = boundingRadius(low, high);
    if (!(*request.ortho_height >= kMinHeightRadii * radius && *request.ortho_height <= kFarthestRadii * radius))
        throw Error{ExitCode::kBadUsage, "--ortho: must be from 0.00001 to 10000 scene radii"};
    return *request.ortho_height;
}

} // namespace

bool isWithinCameraRange(Vec3 point, Vec3 bounds_min, Vec3 bounds_max) {
    const Vec3 centre = bounds_min + (bounds_max - bounds_min) * 0.5;
    return length(point - centre) <= kFarthestRadii * boundingRadius(bounds_min, bounds_max);
}

double framingHeight(Vec3 bounds_min, Vec3 bounds_max, double aspect) {
    return 2 * boundingRadius(bounds_min, bounds_max) / std::min(1.0, aspect);
}

Vec3 frontSide(Vec3 up) {
    const Vec3 axis = normalize(withinRange(up));
    const double towards = axis.y < -0.5 ? -1 : 1; // if y points down, as in camera coordinates, cameras look along z
    const Vec3 front = std::abs(axis.z) > 0.5 ? Vec3{0, -1, 0} : Vec3{0, 0, towards};
    return normalize(front - dot(front, axis) * axis);
}

double verticalHalfAngle(double fov_deg) { return fov_deg / 2 * std::numbers::pi / 180; }

double horizontalHalfAngle(double fov_deg, double aspect) {
    return std::atan(std::tan(verticalHalfAngle(fov_deg)) * aspect);
}

Camera frameCamera(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, double aspect) {
    requireUsable(request);
    const Vec3 centre = bounds_min + (bounds_max - bounds_min) * 0.5;
    const double radius = boundingRadius(bounds_min, bounds_max);
    requireNear("--eye", request.eye, bounds_min, bounds_max);
    requireNear("--target", request.target, bounds_min, bounds_max);
    Vec3 target = request.target.value_or(centre);
    double distance = framingDistance(radius, request.fov_deg, aspect);
    if (isParallelProjection(request)) distance += std::max(0.0, dot(request.side, centre - target));
    const Vec3 back = request.side * distance;

    const Vec3 eye = request.eye.value_or(target + back);
    if (!(length(target - eye) > 0)) target = eye - back;

    Camera camera;
    camera.fov_deg = request.fov_deg;
    camera.ortho_height = windowHeight(request, bounds_min, bounds_max, aspect);
    camera.eye = eye;
    camera.forward = normalize(target - eye);
    camera.right =
        normalize(cross(camera.forward, usableUp(withinRange(request.up.value_or(Vec3{0, 1, 0})), camera.forward)));
    camera.up = cross(camera.right, camera.forward);
    camera.panorama = request.panorama;
    return camera.panorama ? levelCamera(camera, request.up ? withinRange(*request.up) : Vec3{0, 1, 0}) : camera;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/frame_params.h"

#include <algorithm>
#include <numbers>

#include "runtime/camera.h"

namespace pointrt {

namespace {

using std::numbers::pi;

/// Rooms in multiples of the scene's bounding radius. Mirrors stand close, so that their images are large; matte walls
/// stand back, where the lights leave no bright spots.
struct RoomSize {
    double half_width, height;
};
constexpr RoomSize kMirrorRoom{1.8, 3.0};
constexpr RoomSize kMatteRoom{3.6, 5.0};

/// The ring of lights, in the same unit: inside either room, whose floor is at most 1 below the centre.
constexpr double kRingRadius = 1.5;
constexpr double kRingHeight = 1.9;
/// Share left between the eye and a wall behind it.
constexpr double kEyeMargin = 0.05;
/// The first light stands this far to the left of the eye, as a key light does.
constexpr double kKeyLightAngle = -40.0 * pi / 180.0;
/// Radiance that all lights together give a white surface at the scene's centre that faces them.
constexpr double kLightSum = 1.5;

struct Staging {
    Vec3 center, eye, up; ///< cube units; up is an axis
    double radius = 0;    ///< of the sphere around the splats
    double floor = 0;     ///< lowest splat along up, measured from center
};

Vec3 cubePoint(const pro_info& info, Vec3 input) {
    return (input - Vec3{info.origin[0], info.origin[1], info.origin[2]}) * (1.0 / info.scale);
}

/// The axis nearest to v: floors are level in scans whose up is not quite.
Vec3 nearestAxis(Vec3 v) {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    if (y >= x && y >= z) return {0, std::copysign(1.0, v.y), 0};
    return z >= x ? Vec3{0, 0, std::copysign(1.0, v.z)} : Vec3{std::copysign(1.0, v.x), 0, 0};
}

Staging stageScene(const Scene& scene, const RenderSettings& settings, const Camera& camera) {
    const pro_info& info = scene.info;
    const Vec3 lo = cubePoint(info, {info.bounds_min[0], info.bounds_min[1], info.bounds_min[2]});
    const Vec3 hi = cubePoint(info, {info.bounds_max[0], info.bounds_max[1], info.bounds_max[2]});
    Staging staging;
    staging.center = 0.5 * (lo + hi);
    staging.eye = cubePoint(info, camera.eye);
    staging.up = nearestAxis(settings.camera.up.value_or(Vec3{0, 1, 0}));
    staging.radius =
        std::max(0.5 * length(hi - lo), static_cast<double>(info.radius_max)); // a lone splat has a size too
    const Vec3 size = hi - lo;
    staging.floor = -0.5 * std::abs(dot(size, staging.up));
    return staging;
}

gpu::vec4 pack(Vec3 v, double w = 0) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// Lowest and highest corner of the room: its floor carries the scene, and the eye is inside.
void placeRoom(const Staging& staging, Room room, gpu::FrameParams& params) {
    const RoomSize size = room == Room::kMirror ? kMirrorRoom : kMatteRoom;
    const auto axisBounds = [&](Vec3 axis, double& lo, double& hi) {
        const double along = dot(staging.up, axis), center = dot(staging.center, axis), eye = dot(staging.eye, axis);
        lo = center - size.half_width * staging.radius;
        hi = center + size.half_width * staging.radius;
        const double room_top = staging.floor + size.height * staging.radius;
        if (along > 0) lo = center + staging.floor, hi = center + room_top;
        if (along < 0) lo = center - room_top, hi = center - staging.floor;
        const double margin = kEyeMargin * staging.radius;
        lo = std::min(lo, eye - margin);
        hi = std::max(hi, eye + margin);
    };
    Vec3 lo, hi;
    axisBounds({1, 0, 0}, lo.x, hi.x);
    axisBounds({0, 1, 0}, lo.y, hi.y);
    axisBounds({0, 0, 1}, lo.z, hi.z);
    params.room_lo = pack(lo);
    params.room_hi = pack(hi);
}

/// N lights on a ring above the scene, the first to the left of the eye.
void placeLights(const Staging& staging, const RenderSettings& settings, gpu::FrameParams& params) {
    const Vec3 side = std::abs(staging.up.y) > 0.5 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    Vec3 towards_eye = staging.eye - staging.center;
    towards_eye = towards_eye - dot(towards_eye, staging.up) * staging.up;
    towards_eye = length(towards_eye) > 1e-6 ? normalize(towards_eye) : side;
    const Vec3 right = cross(staging.up, towards_eye);
    const double distance = std::hypot(kRingRadius, kRingHeight) * staging.radius;
    for (std::uint32_t l = 0; l < settings.lights; ++l) {
        const double angle = kKeyLightAngle + 2 * pi * l / settings.lights;
        const Vec3 around = std::cos(angle) * towards_eye + std::sin(angle) * right;
        const Vec3 at = staging.center + staging.radius * (kRingRadius * around + kRingHeight * staging.up);
        const double power = kLightSum / settings.lights * distance * distance;
        params.light_position[l] = pack(at);
        params.light_power[l] = pack({power, power, power});
    }
}

std::uint32_t optionBits(const Scene& scene, const RenderSettings& settings) {
    return (settings.blend ? OPTION_BLEND : 0u) | (settings.shadows ? OPTION_SHADOWS : 0u) |
           ((scene.info.flags & PRO_FLAG_ORIENTED) ? OPTION_ORIENTED : 0u) |
           (settings.reflectivity ? OPTION_OVERRIDE_REFLECTIVITY : 0u);
}

} // namespace

gpu::FrameParams makeFrameParams(const Scene& scene, const RenderSettings& settings, const Camera& camera,
                                 std::uint32_t first_row, std::uint32_t rows) {
    const Staging staging = stageScene(scene, settings, camera);
    const pro_info& info = scene.info;
    gpu::FrameParams params{};
    params.eye = pack(staging.eye, std::tan(verticalHalfAngle(camera.fov_deg)));
    params.right = pack(camera.right, static_cast<double>(settings.width) / settings.height);
    params.up = pack(camera.up);
    params.forward = pack(camera.forward);
    params.splat = {info.radius_max, info.radius_step, info.blend_slab, settings.reflectivity.value_or(0.0f)};
    params.sky_up = pack(staging.up, length(staging.eye - staging.center) + staging.radius);
    params.image = {settings.width, settings.height, first_row, rows};
    const EntryGrid& grid = scene.grid_frame;
    params.scene = {settings.lights, optionBits(scene, settings), 0, 0};
    params.grid_origin = {grid.origin[0], grid.origin[1], grid.origin[2], 0};
    params.grid_size = {grid.size[0], grid.size[1], grid.size[2], grid.size[0] * grid.size[1] * grid.size[2] - 1};
    const float cells = std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - grid.shift));
    params.grid_scale = {cells, static_cast<float>(grid.size[0]),
                         static_cast<float>(grid.size[0]) * static_cast<float>(grid.size[1]),
                         cells * PRO_POSITION_STEP};
    params.mode = {static_cast<std::uint32_t>(settings.integrator), settings.bounces,
                   static_cast<std::uint32_t>(settings.room), settings.seed};
    placeRoom(staging, settings.room, params);
    placeLights(staging, settings, params);
    return params;
}

Vec3 centerRayDirection(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    const double tangent = std::tan(verticalHalfAngle(camera.fov_deg)),
                 aspect = static_cast<double>(settings.width) / settings.height;
    const double across = (2.0 * (x + 0.5) / settings.width - 1.0) * tangent * aspect;
    const double upwards = (1.0 - 2.0 * (y + 0.5) / settings.height) * tangent;
    return normalize(camera.forward + across * camera.right + upwards * camera.up);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/light_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/scene/sun.h"

namespace pointrt {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;
/// The most that scene files take.
constexpr double kMaxLight = 1e12;

Color& emission(PointLight& light) { return light.intensity; }
Color& emission(SpotLight& light) { return light.intensity; }
Color& emission(SunLight& light) { return light.irradiance; }
Color& emission(SphereLight& light) { return light.radiance; }
Color& emission(QuadLight& light) { return light.radiance; }

// Irradiance a unit of reach squared away, by the light's number.
double givenBy(const PointLight&, double) { return 1; }
double givenBy(const SpotLight&, double) { return 1; }
double givenBy(const SunLight&, double reach) { return reach * reach; }
double givenBy(const SphereLight& light, double) { return pi * light.radius * light.radius; }
double givenBy(const QuadLight& light, double) { return 4 * length(light.u) * length(light.v); }

double brightnessOfOne(const LightDescription& light, double reach) {
    return std::visit([&](const auto& kind) { return givenBy(kind, reach); }, light) / (pi * reach * reach);
}

double brightest(const Color& color) { return std::max({color[0], color[1], color[2]}); }

Color scaled(const Color& color, double factor) {
    if (!std::isfinite(factor)) return color;
    Color result;
    for (std::size_t c = 0; c < color.size(); ++c)
        result[c] = static_cast<float>(std::clamp(factor * color[c], 0.0, kMaxLight));
    return result;
}

/// Any unit vector at right angles to v.
Vec3 across(Vec3 v) { return normalize(std::abs(v.x) < 0.7 ? cross(v, Vec3{1, 0, 0}) : cross(v, Vec3{0, 1, 0})); }

/// As large beside the scene as a window or a softbox beside a person.
constexpr double kLampRadius = 0.2, kPanelHalfEdge = 0.4;
constexpr double kNewBrightness = 0.7;

LightDescription unlit(LightKind kind, Vec3 position, Vec3 ahead, const LitScene& scene, double distance) {
    switch (kind) {
    case LightKind::kPoint:
        return PointLight{position, {}};
    case LightKind::kSpot: {
        const double outer_deg = std::asin(std::min(1.0, scene.radius / distance)) / kDegree;
        return SpotLight{position, ahead, outer_deg, 0.8 * outer_deg, {}};
    }
    case LightKind::kSun:
        return SunLight{-1.0 * ahead, SunLight{}.radius_deg, {}};
    case LightKind::kSphere:
        return SphereLight{position, kLampRadius * scene.radius, {}, true};
    case LightKind::kQuad:
        break;
    }
    const double half = kPanelHalfEdge * scene.radius;
    QuadLight light{position, {half, 0, 0}, {0, half, 0}, {}, true};
    setNormal(light, ahead, scene.up);
    return light;
}

} // namespace

Color& emissionOf(LightDescription& light) {
    return std::visit([](auto& kind) -> Color& { return emission(kind); }, light);
}

const Color& emissionOf(const LightDescription& light) { return emissionOf(const_cast<LightDescription&>(light)); }

Color tintOf(const LightDescription& light) {
    const Color& color = emissionOf(light);
    const double most = brightest(color);
    return most > 0 && std::isfinite(most) ? scaled(color, 1 / most) : Color{1, 1, 1};
}

void setTint(LightDescription& light, Color tint) {
    const double most = brightest(emissionOf(light));
    if (!(brightest(tint) > 0)) tint = {1, 1, 1};
    emissionOf(light) = scaled(tint, most / brightest(tint));
}

double brightnessOf(const LightDescription& light, double reach) {
    return brightest(emissionOf(light)) * brightnessOfOne(light, reach);
}

void setBrightness(LightDescription& light, double brightness, double reach) {
    const double most = brightness / brightnessOfOne(light, reach);
    if (std::isfinite(most)) emissionOf(light) = scaled(tintOf(light), std::min(most, kMaxLight));
}

void setRadius(SphereLight& light, double radius) {
    const double share = light.radius / radius;
    light.radius = radius;
    light.radiance = scaled(light.radiance, share * share);
}

void setHalfEdges(QuadLight& light, double width, double height) {
    const double old_width = length(light.u), old_height = length(light.v);
    light.u = light.u * (width / old_width);
    light.v = light.v * (height / old_height);
    light.radiance = scaled(light.radiance, old_width / width * old_height / height);
}

Bearing bearingOf(Vec3 direction, Vec3 up) {
    const double size = length(direction);
    if (!(size > 0) || !std::isfinite(size)) return {0, 90};
    const Vec3 unit = direction * (1 / size), north = defaultNorth(up);
    const double ahead = dot(unit, north), east = dot(unit, cross(north, up)), level = std::hypot(ahead, east);
    constexpr double none = 1e-9; // rounding's share of straight up
    const double azimuth = level > none ? std::atan2(east, ahead) / kDegree : 0;
    return {azimuth < 0 ? azimuth + 360 : azimuth, std::atan2(dot(unit, up), level) / kDegree};
}

Vec3 directionOf(Bearing bearing, Vec3 up) {
    return normalize(sunDirection({bearing.height_deg, bearing.azimuth_deg}, up, defaultNorth(up)));
}

Vec3 normalOf(const QuadLight& light) {
    const Vec3 normal = cross(light.u, light.v);
    return length(normal) > 0 ? normalize(normal) : Vec3{0, 1, 0};
}

void setNormal(QuadLight& light, Vec3 normal, Vec3 up) {
    constexpr double upright = 1e-6;
    const Vec3 level = cross(up, normal);
    const Vec3 u = length(level) > upright ? normalize(level) : across(normal);
    light.u = u * length(light.u);
    light.v = cross(normal, u) * length(light.v);
}

Vec3* positionOf(LightDescription& light) {
    if (auto* point = std::get_if<PointLight>(&light)) return &point->position;
    if (auto* spot = std::get_if<SpotLight>(&light)) return &spot->position;
    if (auto* sphere = std::get_if<SphereLight>(&light)) return &sphere->center;
    if (auto* quad = std::get_if<QuadLight>(&light)) return &quad->center;
    return nullptr;
}

LightDescription newLight(LightKind kind, const LitScene& scene) {
    // half a right angle to the left, as far above, and two radii from the middle: outside of the scan
    const Vec3 towards = normalize(scene.eye_back - scene.eye_right + scene.eye_up);
    const double distance = 2 * scene.radius;
    LightDescription light = unlit(kind, scene.centre + distance * towards, -1.0 * towards, scene, distance);
    setBrightness(light, kNewBrightness, distance);
    return light;
}

} // namespace pointrt

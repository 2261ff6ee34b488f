// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/light_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/scene/sun.h"

namespace pointrt {
namespace {

using std::numbers::pi;

/// Limit of scene files.
constexpr double kMaxLight = 1e12;

/// Irradiance times reach squared, per unit of the light's emission.
double irradiancePerUnit(const EmissionField& emission, double reach) {
    switch (emission.quantity) {
    case EmissionField::Quantity::kIntensity:
        return 1;
    case EmissionField::Quantity::kIrradiance:
        return reach * reach;
    case EmissionField::Quantity::kRadiance:
        break;
    }
    return emission.seen_area;
}

double brightnessOfOne(LightDescription light, double reach) {
    return irradiancePerUnit(emissionField(light), reach) / (pi * reach * reach);
}

double brightest(const Color& color) { return std::max({color[0], color[1], color[2]}); }

constexpr double kNewBrightness = 0.7;

} // namespace

Color& emissionOf(LightDescription& light) { return emissionField(light).value; }

const Color& emissionOf(const LightDescription& light) { return emissionOf(const_cast<LightDescription&>(light)); }

Color scaledColor(const Color& color, double factor) {
    if (!std::isfinite(factor)) return color;
    Color result;
    for (std::size_t c = 0; c < color.size(); ++c)
        result[c] = static_cast<float>(std::clamp(factor * color[c], 0.0, kMaxLight));
    return result;
}

Color tintOf(const LightDescription& light) {
    const Color& color = emissionOf(light);
    const double most = brightest(color);
    return most > 0 && std::isfinite(most) ? scaledColor(color, 1 / most) : Color{1, 1, 1};
}

void setTint(LightDescription& light, Color tint) {
    const double most = brightest(emissionOf(light));
    if (!(brightest(tint) > 0)) tint = {1, 1, 1};
    emissionOf(light) = scaledColor(tint, most / brightest(tint));
}

double brightnessOf(const LightDescription& light, double reach) {
    return brightest(emissionOf(light)) * brightnessOfOne(light, reach);
}

void setBrightness(LightDescription& light, double brightness, double reach) {
    const double most = brightness / brightnessOfOne(light, reach);
    if (std::isfinite(most)) emissionOf(light) = scaledColor(tintOf(light), std::min(most, kMaxLight));
}

Bearing bearingOf(Vec3 direction, Vec3 up) {
    const double size = length(direction);
    if (!(size > 0) || !std::isfinite(size)) return {0, 90};
    const Vec3 unit = direction * (1 / size), north = defaultNorth(up);
    const double ahead = dot(unit, north), east = dot(unit, cross(north, up)), level = std::hypot(ahead, east);
    constexpr double none = 1e-9; // horizontal part due to rounding, of a direction straight up
    const double azimuth = level > none ? std::atan2(east, ahead) / kDegree : 0;
    return {azimuth < 0 ? azimuth + 360 : azimuth, std::atan2(dot(unit, up), level) / kDegree};
}

Vec3 directionOf(Bearing bearing, Vec3 up) {
    return normalize(sunDirection({bearing.elevation_deg, bearing.azimuth_deg}, up, defaultNorth(up)));
}

LightDescription newLight(std::size_t kind, const LitScene& scene) {
    // 45 degrees to the left and as far up, at twice the scene's radius: outside the scan
    const Vec3 towards = normalize(scene.eye_back - scene.eye_right + scene.eye_up);
    const double distance = 2 * scene.radius;
    LightDescription light =
        newLightAt(kind, {scene.centre + distance * towards, -1.0 * towards, scene.up, scene.radius, distance});
    setBrightness(light, kNewBrightness, distance);
    return light;
}

} // namespace pointrt

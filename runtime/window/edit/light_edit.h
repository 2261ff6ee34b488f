// SPDX-License-Identifier: Apache-2.0
// Lights as the panel presents them: tint, a brightness comparable across kinds, azimuth and elevation.
#pragma once

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The light's emission in its own unit: intensity, irradiance or radiance.
Color& emissionOf(LightDescription& light);
const Color& emissionOf(const LightDescription& light);

/// The emission scaled to a maximum channel of 1; white if the light is off.
Color tintOf(const LightDescription& light);
/// Keeps the maximum channel. tint: 0 to 1 each; black counts as white.
void setTint(LightDescription& light, Color tint);

/// Radiance of a white surface facing the light at distance reach (suns: at any distance); 1 is displayed as white.
/// reach: world units, above 0. Assumes that the light is much smaller than reach.
double brightnessOf(const LightDescription& light, double reach);
/// Keeps the tint. brightness: 0 or more; the emission is clamped to the limits of scene files.
void setBrightness(LightDescription& light, double brightness, double reach);

/// color * factor, clamped to the limits of scene files.
Color scaledColor(const Color& color, double factor);

/// Runs change(), which resizes the light, and keeps its brightness.
template <Light L, typename Change>
void resize(L& light, Change&& change) {
    const double seen_before = light.emission().seen_area;
    change();
    const EmissionField emission = light.emission();
    emission.value = scaledColor(emission.value, seen_before / emission.seen_area);
}

/// A direction as azimuth and elevation.
struct Bearing {
    double azimuth_deg = 0;   ///< clockwise from north (defaultNorth, sun.h), 0 to 360; 0 straight up or down
    double elevation_deg = 0; ///< above the horizon, -90 to 90
};
/// direction: any length; zero counts as up. up: unit length.
Bearing bearingOf(Vec3 direction, Vec3 up);
Vec3 directionOf(Bearing bearing, Vec3 up);

/// Where newLight places a light: the scene's bounding sphere, and the camera's axes.
struct LitScene {
    Vec3 centre, up;                  ///< up: unit length
    double radius = 1;                ///< above 0
    Vec3 eye_right, eye_up, eye_back; ///< orthonormal
};
/// A light of the kind with this index, above the viewer's left shoulder and aimed at the scene's centre, where its
/// brightness is 0.7.
LightDescription newLight(std::size_t kind, const LitScene& scene);

} // namespace pointrt

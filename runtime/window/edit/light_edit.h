// SPDX-License-Identifier: Apache-2.0
// Lights as users handle them: a tint, a brightness that means the same for every kind, a bearing.
#pragma once

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// What the light gives, in its own unit: intensity, irradiance or radiance.
Color& emissionOf(LightDescription& light);
const Color& emissionOf(const LightDescription& light);

/// The colour of its light, brightest channel 1; white where it gives none.
Color tintOf(const LightDescription& light);
/// Keeps the brightest channel. tint: 0 to 1 each; black counts as white.
void setTint(LightDescription& light, Color tint);

/// What a white surface that faces it gives back as radiance, from reach away (suns: from anywhere): 1 shows white.
/// reach: world units, above 0. Lamps with a size count as far smaller than reach.
double brightnessOf(const LightDescription& light, double reach);
/// Keeps the tint. brightness: from 0 up; the light's own number stays within what scene files take.
void setBrightness(LightDescription& light, double brightness, double reach);

/// The colour times factor, within what scene files take.
Color scaledColor(const Color& color, double factor);

/// What change() makes of the light's size, as bright as before.
template <Light L, typename Change>
void resize(L& light, Change&& change) {
    const double seen_before = light.emission().seen_area;
    change();
    const EmissionField emission = light.emission();
    emission.value = scaledColor(emission.value, seen_before / emission.seen_area);
}

/// A direction as a compass and a spirit level have it.
struct Bearing {
    double azimuth_deg = 0;   ///< from north (defaultNorth, sun.h) by way of east, 0 to 360; 0 straight up and down
    double elevation_deg = 0; ///< over the horizon, -90 to 90
};
/// direction: of any length; what is none counts as up. up: unit length.
Bearing bearingOf(Vec3 direction, Vec3 up);
Vec3 directionOf(Bearing bearing, Vec3 up);

/// The scene that a light is made for: a sphere around it, and from where it is looked at.
struct LitScene {
    Vec3 centre, up;                  ///< up: unit length
    double radius = 1;                ///< above 0
    Vec3 eye_right, eye_up, eye_back; ///< orthonormal
};
/// A light of this kind, by number, above the viewer's left shoulder, turned to the scene, of brightness 0.7 there.
LightDescription newLight(std::size_t kind, const LitScene& scene);

} // namespace pointrt

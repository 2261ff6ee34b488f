// SPDX-License-Identifier: Apache-2.0
// The values that lights are made of. Each kind of light lists its own, once: scene files are read and written, panels
// drawn and lengths brought to render units by what each of these types is, and where one of them has no answer for a
// type, it does not compile.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/util/color.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// The names of a light's values in scene files.
using FieldKeys = std::vector<std::string_view>;

/// Where it stands.
struct PositionField {
    const char* key;
    Vec3& value;
    /// Whether a light that is brought to the camera then looks the way that the camera does.
    bool turns = false;
    FieldKeys keys() const { return {key}; }
};

/// Unit vector: where it points, or where its face looks. In scene files also as a point to look at.
struct AimField {
    const char* key;
    Vec3& value;
    PositionField from;
    bool flat = false;
    FieldKeys keys() const { return {"target", key}; }
};

/// Unit vector to the sun. In scene files also as a place and time.
struct SunwardField {
    Vec3& value;
    FieldKeys keys() const { return {"towards", "time", "latitude", "longitude", "north"}; }
};

/// A spot's.
struct ConeField {
    static constexpr double kNarrowest = 0.1, kWidest = 90;
    double& outer_deg; ///< half angle
    double& inner_deg; ///< undimmed inside of this half angle, at most outer_deg
    FieldKeys keys() const { return {"outer", "inner"}; }
};

/// Half the angle that the sun's disc is seen under.
struct AngularRadiusField {
    static constexpr double kWidest = 45;
    double& degrees;
    FieldKeys keys() const { return {"angular_radius"}; }
};

/// Of a lamp.
struct RadiusField {
    double& value;
    FieldKeys keys() const { return {"radius"}; }
};

/// Half edges of a rectangle, at right angles.
struct HalfEdgesField {
    Vec3 &u, &v;
    FieldKeys keys() const { return {"u", "v"}; }
};

/// Whether the lamp itself is in the picture.
struct VisibleField {
    bool& value;
    FieldKeys keys() const { return {"seen_by_camera"}; }
};

/// How strong a light is, by what its number means.
struct EmissionField {
    enum class Quantity { kIntensity, kIrradiance, kRadiance };
    Quantity quantity;
    Color& value;
    double seen_area = 0;               ///< of radiance: as seen from far off, where it faces
    std::optional<double> watts_of_one; ///< power of a light whose number is 1; none: not given in watts

    const char* key() const {
        constexpr const char* keys[] = {"intensity", "irradiance", "radiance"};
        return keys[static_cast<std::size_t>(quantity)];
    }
    FieldKeys keys() const {
        FieldKeys keys{"color", key()};
        if (watts_of_one) keys.push_back("power");
        return keys;
    }
};

/// Irradiance on a facing surface at unit distance.
inline EmissionField intensityField(Color& value, std::optional<double> watts_of_one = {}) {
    return {EmissionField::Quantity::kIntensity, value, 0, watts_of_one};
}
/// On a surface that faces it.
inline EmissionField irradianceField(Color& value) { return {EmissionField::Quantity::kIrradiance, value, 0, {}}; }
/// shining_area: all that gives off light.
inline EmissionField radianceField(Color& value, double seen_area, double shining_area) {
    return {EmissionField::Quantity::kRadiance, value, seen_area, std::numbers::pi * shining_area};
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The types of values that lights consist of. Each kind of light lists its values once; reading and writing scene
// files, panels, and the conversion to render units handle each type, and fail to compile if they miss one.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/scene/layer.h"
#include "runtime/util/color.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// The names of a light's values in scene files.
using FieldKeys = std::vector<std::string_view>;

/// A position.
struct PositionField {
    const char* key;
    Vec3& value;
    /// True if moving the light to the camera also aims it along the view direction.
    bool turns = false;
    FieldKeys keys() const { return {key}; }
};

/// Unit vector: the light's direction, or the normal of its face. Scene files can give a point to aim at instead.
struct AimField {
    const char* key;
    Vec3& value;
    PositionField from;
    bool flat = false;
    FieldKeys keys() const { return {"target", key}; }
};

/// Unit vector to the sun. Scene files can give a place and a time instead.
struct SunwardField {
    Vec3& value;
    FieldKeys keys() const { return {"towards", "time", "latitude", "longitude", "north"}; }
};

/// The cone of a spot light.
struct ConeField {
    static constexpr double kNarrowest = 0.1, kWidest = 90;
    double& outer_deg; ///< half angle
    double& inner_deg; ///< full intensity within this half angle, at most outer_deg
    FieldKeys keys() const { return {"outer", "inner"}; }
};

/// Angular radius of the sun's disc.
struct AngularRadiusField {
    static constexpr double kWidest = 45;
    double& degrees;
    FieldKeys keys() const { return {"angular_radius"}; }
};

/// Radius of a lamp.
struct RadiusField {
    double& value;
    FieldKeys keys() const { return {"radius"}; }
};

/// Vectors from the centre of a rectangle to the middles of two edges; perpendicular to each other.
struct HalfEdgesField {
    Vec3 &u, &v;
    FieldKeys keys() const { return {"u", "v"}; }
};

/// True if camera rays can hit the lamp itself.
struct VisibleField {
    bool& value;
    FieldKeys keys() const { return {"seen_by_camera"}; }
};

/// Whether the light is on, its name, and whether it is locked.
struct LayerField {
    bool& visible;
    Layer& layer;
    FieldKeys keys() const { return {"name", "visible", "locked"}; }
};

/// The strength of a light, and its quantity.
struct EmissionField {
    enum class Quantity { kIntensity, kIrradiance, kRadiance };
    Quantity quantity;
    Color& value;
    double seen_area = 0;               ///< for radiance: the projected area, seen from the front at a large distance
    std::optional<double> watts_of_one; ///< power of a light of strength 1; none: the strength cannot be given in watts

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

/// Irradiance at unit distance on a surface that faces the light.
inline EmissionField intensityField(Color& value, std::optional<double> watts_of_one = {}) {
    return {EmissionField::Quantity::kIntensity, value, 0, watts_of_one};
}
/// Irradiance on a surface that faces the light.
inline EmissionField irradianceField(Color& value) { return {EmissionField::Quantity::kIrradiance, value, 0, {}}; }
/// shining_area: total emitting area.
inline EmissionField radianceField(Color& value, double seen_area, double shining_area) {
    return {EmissionField::Quantity::kRadiance, value, seen_area, std::numbers::pi * shining_area};
}

} // namespace pointrt

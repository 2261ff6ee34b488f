// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct SunLight {
    Vec3 towards;               ///< unit vector to the sun
    double radius_deg = 0.2665; ///< angular radius of its disc, 0 to 45; 0 gives hard shadows
    Color irradiance;           ///< irradiance on a surface that faces the sun
    bool visible = true;        ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const SunLight&) const = default;

    static constexpr LightNames kNames{"sun", "a sun", "Sun", "from far away, parallel"};

    EmissionField emission() { return irradianceField(irradiance); }
    void eachField(auto&& on) {
        on(SunwardField{towards});
        on(AngularRadiusField{radius_deg});
        on(emission());
        on(LayerField{visible, layer});
    }

    static SunLight newAt(const LightPlace& place) { return {-1.0 * place.ahead, SunLight{}.radius_deg, {}}; }

    bool isSoft() const { return radius_deg > 0; }
    NoSurface surface() const { return {}; }

    gpu::Light row() const {
        gpu::Light row{{}, packColor(irradiance), pack(towards), {}, {}};
        SUN_COSINE(row) = static_cast<float>(cosineOf(radius_deg));
        return row;
    }

    /// Starts on a disc of the target's radius, outside the scene, in the direction of a random point of the sun.
    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        using std::numbers::pi;
        const PhotonTarget& target = aim.target;
        const double cap = 1 - double{SUN_COSINE(row)};
        const Vec3 towards = Frame(unpack(row.axis)).at(1 - cap * aim.u[2], aim.u[3]);
        const Frame across(towards);
        const double ring = target.radius * std::sqrt(aim.u[0]), angle = 2 * pi * aim.u[1];
        const double distance = length(target.center - aim.scene.center) + 1.01 * aim.scene.radius;
        const Vec3 origin =
            target.center + distance * towards + ring * std::cos(angle) * across.s + ring * std::sin(angle) * across.t;
        // light from the rim of a wide sun meets the plane facing its centre obliquely (shaders/shade/sun_light.glsl)
        return {origin, -1.0 * towards, pi * target.radius * target.radius * 2 / (2 - cap)};
    }
};

} // namespace pointrt

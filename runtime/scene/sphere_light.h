// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct SphereLight {
    Vec3 center;
    double radius = 1;
    Color radiance;
    bool seen_by_camera = true;
    bool visible = true; ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const SphereLight&) const = default;

    static constexpr LightNames kNames{"sphere", "a sphere light", "Sphere", "a ball, soft shadows"};

    EmissionField emission() {
        using std::numbers::pi;
        return radianceField(radiance, pi * radius * radius, 4 * pi * radius * radius);
    }
    void eachField(auto&& on) {
        on(PositionField{"center", center});
        on(RadiusField{radius});
        on(emission());
        on(VisibleField{seen_by_camera});
        on(LayerField{visible, layer});
    }

    static SphereLight newAt(const LightPlace& place) {
        return {place.position, kLampRadius * place.scene_radius, {}, true};
    }

    bool isSoft() const { return true; }
    LampSurface surface() const {
        return {SHAPE_SPHERE, center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}, seen_by_camera};
    }

    gpu::Light row() const {
        gpu::Light row{pack(center), packColor(radiance), {}, {}, {}};
        SPHERE_RADIUS(row) = static_cast<float>(radius);
        return row;
    }

    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        const double radius = SPHERE_RADIUS(row);
        const Vec3 way = aim.target.center - unpack(row.position);
        const double distance = std::max(length(way), 1e-300);
        // the cap of the lamp from which part of the target is above the horizon
        const double cap = 1 - std::clamp((radius - aim.target.radius) / distance, -1.0, 1.0);
        const Vec3 towards = distance > 1e-300 ? normalize(way) : Vec3{0, 0, 1};
        const Vec3 normal = Frame(towards).at(1 - cap * aim.u[2], aim.u[3]);
        return photonFromSurface(unpack(row.position) + radius * (1 + kPhotonLift) * normal, normal,
                                 2 * std::numbers::pi * cap * radius * radius, false, aim);
    }
};

} // namespace pointrt

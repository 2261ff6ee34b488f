// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct DiscLight {
    Vec3 center, normal{0, -1, 0}; ///< normal: unit length; both sides emit
    double radius = 1;
    Color radiance;
    bool seen_by_camera = true;
    bool visible = true; ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const DiscLight&) const = default;

    static constexpr LightNames kNames{"disc", "a disc light", "Disc", "flat and round, soft shadows"};

    EmissionField emission() {
        const double area = std::numbers::pi * radius * radius;
        return radianceField(radiance, area, 2 * area);
    }
    void eachField(auto&& on) {
        on(PositionField{"center", center});
        on(AimField{"normal", normal, {"center", center}, true});
        on(RadiusField{radius});
        on(emission());
        on(VisibleField{seen_by_camera});
        on(LayerField{visible, layer});
    }

    Vec3 facing() const { return normal; }
    void face(Vec3 ahead, Vec3) { normal = ahead; }
    static DiscLight newAt(const LightPlace& place) {
        return {place.position, place.ahead, kPanelHalfEdge * place.scene_radius, {}, true};
    }

    bool isSoft() const { return true; }
    LampSurface surface() const {
        const Vec3 u = radius * across(normal);
        return {SHAPE_DISC, center, u, cross(normal, u), normal, seen_by_camera};
    }

    gpu::Light row() const {
        const Vec3 u = radius * across(normal);
        return {pack(center), packColor(radiance), pack(normal), pack(u), pack(cross(normal, u))};
    }

    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        using std::numbers::pi;
        const Vec3 u = unpack(row.edge_u), v = unpack(row.edge_v);
        const double ring = std::sqrt(aim.u[2]), angle = 2 * pi * aim.u[3];
        const Vec3 on_lamp = unpack(row.position) + ring * std::cos(angle) * u + ring * std::sin(angle) * v;
        return photonFromFlat(on_lamp, unpack(row.axis), pi * dot(u, u), aim);
    }
};

} // namespace pointrt

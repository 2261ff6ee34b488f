// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct QuadLight {
    Vec3 center, u, v; ///< u, v: perpendicular half edges; both sides emit
    Color radiance;
    bool seen_by_camera = true;
    bool visible = true; ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const QuadLight&) const = default;

    static constexpr LightNames kNames{"quad", "a quad light", "Softbox", "a rectangle, soft shadows"};

    EmissionField emission() {
        return radianceField(radiance, 4 * length(u) * length(v), 2 * 4 * length(u) * length(v));
    }
    void eachField(auto&& on) {
        on(PositionField{"center", center});
        on(HalfEdgesField{u, v});
        on(emission());
        on(VisibleField{seen_by_camera});
        on(LayerField{visible, layer});
    }

    Vec3 facing() const {
        const Vec3 normal = cross(u, v);
        return length(normal) > 0 ? normalize(normal) : Vec3{0, 1, 0};
    }
    /// Makes the edge u perpendicular to up.
    void face(Vec3 normal, Vec3 up) {
        constexpr double min_sine = 1e-6;
        const Vec3 level = cross(up, normal);
        const Vec3 along = length(level) > min_sine ? normalize(level) : across(normal);
        u = along * length(u);
        v = cross(normal, along) * length(v);
    }
    static QuadLight newAt(const LightPlace& place) {
        const double half = kPanelHalfEdge * place.scene_radius;
        QuadLight light{place.position, {half, 0, 0}, {0, half, 0}, {}, true};
        light.face(place.ahead, place.up);
        return light;
    }

    bool isSoft() const { return true; }
    LampSurface surface() const { return {SHAPE_QUAD, center, u, v, normalize(cross(u, v)), seen_by_camera}; }

    gpu::Light row() const {
        return {pack(center), packColor(radiance), pack(normalize(cross(u, v))), pack(u), pack(v)};
    }

    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        const Vec3 half_u = unpack(row.edge_u), half_v = unpack(row.edge_v);
        const double area = 4 * length(half_u) * length(half_v);
        const Vec3 on_lamp = unpack(row.position) + (2 * aim.u[2] - 1) * half_u + (2 * aim.u[3] - 1) * half_v;
        return photonFromFlat(on_lamp, unpack(row.axis), area, aim);
    }
};

} // namespace pointrt

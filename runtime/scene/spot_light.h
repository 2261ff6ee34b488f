// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct SpotLight {
    Vec3 position, direction; ///< direction: unit length
    double outer_deg = 30;    ///< half angle of the cone, in (0, 90]
    double inner_deg = 25;    ///< full intensity within this half angle, at most outer_deg
    Color intensity;
    bool visible = true; ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const SpotLight&) const = default;

    static constexpr LightNames kNames{"spot", "a spot light", "Spot", "a cone, hard shadows"};

    EmissionField emission() { return intensityField(intensity); }
    void eachField(auto&& on) {
        on(PositionField{"position", position, true});
        on(AimField{"direction", direction, {"position", position}});
        on(ConeField{outer_deg, inner_deg});
        on(emission());
        on(LayerField{visible, layer});
    }

    Vec3 facing() const { return direction; }
    void face(Vec3 ahead, Vec3) { direction = ahead; }
    static SpotLight newAt(const LightPlace& place) {
        const double outer = std::asin(std::min(1.0, place.scene_radius / place.distance)) / kDegree;
        return {place.position, place.ahead, outer, 0.8 * outer, {}};
    }

    bool isSoft() const { return false; }
    NoSurface surface() const { return {}; }

    gpu::Light row() const {
        gpu::Light row{pack(position), packColor(intensity), pack(direction), {}, {}};
        SPOT_OUTER_COSINE(row) = static_cast<float>(cosineOf(outer_deg));
        SPOT_INNER_COSINE(row) = static_cast<float>(cosineOf(inner_deg));
        return row;
    }

    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        const Vec3 origin = unpack(row.position), axis = unpack(row.axis);
        const double outer_cosine = SPOT_OUTER_COSINE(row), inner_cosine = SPOT_INNER_COSINE(row);
        const Cone lit{axis, 1 - outer_cosine}, target = coneTo(aim.target, origin);
        // sample the narrower cone: either may be a small part of the other
        EmittedPhoton photon = photonWithin(lit.cap < target.cap ? lit : target, origin, aim.u[0], aim.u[1]);
        if (1 - dot(photon.direction, target.axis) > target.cap * (1 + 1e-9)) photon.share = 0;
        photon.share *= gpu::spotFalloff(dot(photon.direction, axis), outer_cosine, inner_cosine);
        return photon;
    }
};

} // namespace pointrt

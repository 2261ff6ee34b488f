// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/scene/light_fields.h"
#include "runtime/scene/light_parts.h"
#include "runtime/scene/photon.h"
#include "runtime/util/pack.h"

namespace pointrt {

struct PointLight {
    Vec3 position;
    Color intensity;     ///< irradiance, at unit distance, on a surface that faces the light
    bool visible = true; ///< false: the light is off, and its surface does not exist
    Layer layer{};
    bool operator==(const PointLight&) const = default;

    static constexpr LightNames kNames{"point", "a point light", "Point", "no size, hard shadows"};

    EmissionField emission() { return intensityField(intensity, 4 * std::numbers::pi); }
    void eachField(auto&& on) {
        on(PositionField{"position", position});
        on(emission());
        on(LayerField{visible, layer});
    }

    static PointLight newAt(const LightPlace& place) { return {place.position, {}}; }

    bool isSoft() const { return false; }
    NoSurface surface() const { return {}; }

    gpu::Light row() const { return {pack(position), packColor(intensity), {}, {}, {}}; }

    static EmittedPhoton photon(const gpu::Light& row, const PhotonAim& aim) {
        const Vec3 origin = unpack(row.position);
        return photonWithin(coneTo(aim.target, origin), origin, aim.u[0], aim.u[1]);
    }
};

} // namespace pointrt

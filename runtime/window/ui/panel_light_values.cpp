// SPDX-License-Identifier: Apache-2.0
// Properties of a light.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/window/edit/light_edit.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

/// Range of lamp sizes: 1/1000 of the scene to ten times the scene.
SliderRange sizesIn(const Workspace& w) { return {1e-3 * sceneSize(w), 10 * sceneSize(w), true}; }

constexpr const char* kSize = "%.4g";
constexpr const char* kDegrees = "%.1f\xC2\xB0";

/// Azimuth and elevation of a direction. The poles, where azimuth is undefined, are excluded.
bool bearingRows(Workspace& w, Vec3& direction, const char* tip) {
    const Vec3 up = sceneUpright(w);
    Bearing bearing = bearingOf(direction, up);
    constexpr double steepest = 89.9;
    bool changed = reportSceneEdit(w, sliderRow("Azimuth", bearing.azimuth_deg, {0, 360}, kDegrees, tip));
    changed |= reportSceneEdit(w, sliderRow("Elevation", bearing.elevation_deg, {-steepest, steepest}, kDegrees,
                                            "above the horizon; negative: below it"));
    if (changed)
        direction = directionOf({bearing.azimuth_deg, std::clamp(bearing.elevation_deg, -steepest, steepest)}, up);
    return changed;
}

bool aimButton(Workspace& w, const char* name, const char* tip, int share) {
    return reportSceneEdit(w, columnButton(name, share, false, tip));
}

Vec3 towardsPivot(const Workspace& w, Vec3 from, Vec3 otherwise) {
    const Vec3 ahead = w.camera.pivot - from;
    return length(ahead) > 1e-9 * sceneSize(w) ? normalize(ahead) : otherwise;
}

constexpr const char* kFaceTip = "direction the lamp faces, clockwise from north; it shines on both sides";
constexpr const char* kSizeTip = "a larger lamp is softer but no brighter";

/// Rows for each property of a light, by its type.
template <Light L>
struct FieldRows {
    Workspace& w;
    L& light;
    Vec3* sunward = nullptr;

    void operator()(const PositionField& field) const {
        reportSceneEdit(
            w, pointRow("Position", field.value, sceneSize(w), w.measure_units.unit, "in the scan's coordinates"));
        const char* tip = field.turns ? "move it to the camera, facing the same way" : "move it to the camera";
        if (aimButton(w, "Move here", tip, Aimable<L> ? 2 : 1)) {
            field.value = w.camera.eye;
            if constexpr (Aimable<L>)
                if (field.turns) light.face(axesOf(w.camera).forward, sceneUpright(w));
        }
        if constexpr (Aimable<L>) {
            ImGui::SameLine();
            if (aimButton(w, "Aim", "point it at the centre of the view", 2))
                light.face(towardsPivot(w, field.value, light.facing()), sceneUpright(w));
        }
    }

    void operator()(const AimField& field) const {
        static_assert(Aimable<L>, "a light that points somewhere has facing() and face()");
        bearingRows(w, field.value, field.flat ? kFaceTip : "direction it points, clockwise from north");
    }

    void operator()(const SunwardField& field) {
        bearingRows(w, field.value, "direction of the sun, clockwise from north");
        sunward = &field.value;
    }

    void operator()(const ConeField& field) const {
        const double outer_deg = std::max(0.0, std::min(field.outer_deg, ConeField::kWidest)); // 0 for NaN
        const double undimmed = std::clamp(field.inner_deg / field.outer_deg, 0.0, 1.0);
        if (reportSceneEdit(w, sliderRow("Cone", field.outer_deg, {ConeField::kNarrowest, ConeField::kWidest}, kDegrees,
                                         "half the opening angle")))
            field.inner_deg = undimmed * field.outer_deg;
        reportSceneEdit(w, sliderRow("Inner cone", field.inner_deg, {0, outer_deg}, kDegrees,
                                     "full brightness up to this angle; the rest of the cone is a soft edge"));
    }

    void operator()(const AngularRadiusField& field) const {
        reportSceneEdit(w, sliderRow("Softness", field.degrees, {0, AngularRadiusField::kWidest}, kDegrees,
                                     "angular radius; the sun has 0.27\xC2\xB0, more gives softer shadows"));
    }

    void operator()(const RadiusField& field) const {
        double radius = field.value;
        if (reportSceneEdit(w, sliderRow("Radius", radius, sizesIn(w), lengthFormat(w, kSize).c_str(), kSizeTip)))
            resize(light, [&] { field.value = radius; });
    }

    void operator()(const HalfEdgesField& field) const {
        Vec3 normal = light.facing();
        if (bearingRows(w, normal, kFaceTip)) light.face(normal, sceneUpright(w));
        const double old_width = length(field.u), old_height = length(field.v);
        double width = 2 * old_width, height = 2 * old_height;
        bool sized =
            reportSceneEdit(w, sliderRow("Width", width, sizesIn(w), lengthFormat(w, kSize).c_str(), kSizeTip));
        sized |= reportSceneEdit(w, sliderRow("Length", height, sizesIn(w), lengthFormat(w, kSize).c_str(), kSizeTip));
        if (sized)
            resize(light, [&] {
                field.u = field.u * (0.5 * width / old_width);
                field.v = field.v * (0.5 * height / old_height);
            });
    }

    void operator()(const VisibleField& field) const {
        reportSceneEdit(w, checkboxRow("Visible", field.value, "show the lamp itself in the picture"));
    }

    void operator()(const LayerField&) const {}    // in the list of layers
    void operator()(const EmissionField&) const {} // drawn above, in the same way for all lights
};

template <Light L>
void drawFields(Workspace& w, L& light) {
    FieldRows<L> rows{w, light};
    light.eachField(rows);
    if (rows.sunward) drawSunByDate(w, *rows.sunward);
}

} // namespace

void drawLightValues(Workspace& w, LightDescription& light) {
    Color tint = tintOf(light);
    if (reportSceneEdit(w, colorRow("Colour", tint))) setTint(light, tint);
    double brightness = brightnessOf(light, sceneSize(w));
    if (reportSceneEdit(w, sliderRow("Brightness", brightness, {1e-3, 1e3, true}, "%.3f",
                                     "1: a white surface facing the light, one scene diagonal away, appears white")))
        setBrightness(light, brightness, sceneSize(w));
    std::visit([&](auto& kind) { drawFields(w, kind); }, light);
}

} // namespace pointrt

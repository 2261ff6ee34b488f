// SPDX-License-Identifier: Apache-2.0
// The values of one light.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/window/edit/light_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/widgets/panel_edit.h"
#include "runtime/window/widgets/panel_widgets.h"

namespace pointrt {
namespace {

bool noteScene(Workspace& w, bool changed) { return noteEdit(w.requests, Edit::kScene, changed); }

/// Lengths of lamps, from a thousandth of the scene to ten scenes.
SlideRange sizesIn(const Workspace& w) { return {1e-3 * sceneSize(w), 10 * sceneSize(w), true}; }

constexpr const char* kSize = "%.4g";
constexpr const char* kDegrees = "%.1f\xC2\xB0";

/// A direction by compass and level; straight up and down, where the compass fails, are left out.
bool bearingRows(Workspace& w, Vec3& direction, const char* tip) {
    const Vec3 up = sceneUpright(w);
    Bearing bearing = bearingOf(direction, up);
    constexpr double steepest = 89.9;
    bool changed = noteScene(w, slideRow("Azimuth", bearing.azimuth_deg, {0, 360}, kDegrees, tip));
    changed |= noteScene(w, slideRow("Height", bearing.height_deg, {-steepest, steepest}, kDegrees,
                                     "over the horizon; below 0 from underneath"));
    if (changed)
        direction = directionOf({bearing.azimuth_deg, std::clamp(bearing.height_deg, -steepest, steepest)}, up);
    return changed;
}

/// Where the light stands, and two ways to put it in order.
bool aimButton(Workspace& w, const char* name, const char* tip, int share) {
    return noteScene(w, shareButton(name, share, false, tip));
}

void positionRows(Workspace& w, Vec3& position) {
    noteScene(w, moveRow("Position", position, sceneSize(w), "in the scan's own coordinates"));
}

void drawKind(Workspace& w, PointLight& light) {
    positionRows(w, light.position);
    if (aimButton(w, "Bring it here", "to where the camera is", 1)) light.position = w.camera.eye;
}

Vec3 towardsPivot(const Workspace& w, Vec3 from, Vec3 otherwise) {
    const Vec3 ahead = w.camera.pivot - from;
    return length(ahead) > 1e-9 * sceneSize(w) ? normalize(ahead) : otherwise;
}

void drawKind(Workspace& w, SpotLight& light) {
    positionRows(w, light.position);
    if (aimButton(w, "Bring it here", "to where the camera is, looking the same way", 2)) {
        light.position = w.camera.eye;
        light.direction = axesOf(w.camera).forward;
    }
    ImGui::SameLine();
    if (aimButton(w, "Aim", "at the middle of the picture", 2))
        light.direction = towardsPivot(w, light.position, light.direction);
    bearingRows(w, light.direction, "where it points, from north by way of east");
    const double outer_deg = std::max(0.0, std::min(light.outer_deg, 90.0)); // 0 where it is no number
    const double undimmed = std::clamp(light.inner_deg / light.outer_deg, 0.0, 1.0);
    if (noteScene(w, slideRow("Cone", light.outer_deg, {0.1, 90}, kDegrees, "half of its opening angle")))
        light.inner_deg = undimmed * light.outer_deg;
    noteScene(w, slideRow("Full inside", light.inner_deg, {0, outer_deg}, kDegrees,
                          "undimmed up to this angle; the rest of the cone is its soft edge"));
}

void drawKind(Workspace& w, SunLight& light) {
    bearingRows(w, light.towards, "where it stands, from north by way of east");
    noteScene(w, slideRow("Softness", light.radius_deg, {0, 45}, kDegrees,
                          "angular radius: 0.27\xC2\xB0 is the real sun, more makes shadows softer"));
    drawSunByDate(w, light);
}

void drawKind(Workspace& w, SphereLight& light) {
    positionRows(w, light.center);
    if (aimButton(w, "Bring it here", "to where the camera is", 1)) light.center = w.camera.eye;
    double radius = light.radius;
    if (noteScene(w,
                  slideRow("Radius", radius, sizesIn(w), kSize, "scene units; larger is softer, as bright as before")))
        setRadius(light, radius);
    noteScene(w, switchRow("Visible", light.seen_by_camera, "whether the lamp itself is in the picture"));
}

void drawKind(Workspace& w, QuadLight& light) {
    positionRows(w, light.center);
    const Vec3 up = sceneUpright(w);
    Vec3 normal = normalOf(light);
    bool turned = false;
    if (aimButton(w, "Bring it here", "to where the camera is", 2)) light.center = w.camera.eye;
    ImGui::SameLine();
    if (aimButton(w, "Aim", "at the middle of the picture", 2)) {
        normal = towardsPivot(w, light.center, normal);
        turned = true;
    }
    turned |= bearingRows(w, normal, "where its face looks, from north by way of east; both sides shine");
    if (turned) setNormal(light, normal, up);
    double width = 2 * length(light.u), height = 2 * length(light.v);
    const char* tip = "scene units; larger is softer, as bright as before";
    bool sized = noteScene(w, slideRow("Width", width, sizesIn(w), kSize, tip));
    sized |= noteScene(w, slideRow("Length", height, sizesIn(w), kSize, tip));
    if (sized) setHalfEdges(light, 0.5 * width, 0.5 * height);
    noteScene(w, switchRow("Visible", light.seen_by_camera, "whether the lamp itself is in the picture"));
}

} // namespace

void drawLightValues(Workspace& w, LightDescription& light) {
    Color tint = tintOf(light);
    if (noteScene(w, colorRow("Colour", tint))) setTint(light, tint);
    double brightness = brightnessOf(light, sceneSize(w));
    if (noteScene(w, slideRow("Brightness", brightness, {1e-3, 1e3, true}, "%.3f",
                              "1: a white surface that faces it, one scene's diagonal away, shows white")))
        setBrightness(light, brightness, sceneSize(w));
    std::visit([&](auto& kind) { drawKind(w, kind); }, light);
}

} // namespace pointrt

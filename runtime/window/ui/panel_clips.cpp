// SPDX-License-Identifier: Apache-2.0
// The Clip section: boxes and planes that cut the scans.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "runtime/scene/layers.h"
#include "runtime/window/edit/clip_edit.h"
#include "runtime/window/ui/layer_selection.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

// resolves coordinates of national grids to a metre, those of small scans to a micrometre
constexpr const char* kClipLength = "%.6g";
/// Smallest edge of a box, as a share of the scene: thinner boxes are hard to grab again.
constexpr double kThinnest = 1e-4;

int& selectedClip(const Workspace& w) {
    int& selected = storedInt("selected clip", 0);
    selected = std::clamp(selected, 0, std::max(0, static_cast<int>(w.scene.clips.size()) - 1));
    return selected;
}

bool isBox(const ClipDescription& clip) { return std::holds_alternative<ClipBox>(clip.form); }

void drawClipList(Workspace& w) {
    if (w.scene.clips.empty()) return dimText("Nothing is cut away.");
    for (std::size_t c = 0; c < w.scene.clips.size(); ++c) {
        ClipDescription& clip = w.scene.clips[c];
        std::string name = clip.layer.name;
        if (name.empty()) name = (isBox(clip) ? "Box " : "Plane ") + std::to_string(c + 1);
        ImGui::PushID(static_cast<int>(c));
        reportSceneEdit(w, ImGui::Checkbox("##enabled", &clip.enabled));
        tooltip("turn this clip on or off");
        ImGui::SameLine();
        if (ImGui::Selectable(name.c_str(), static_cast<int>(c) == selectedClip(w))) selectLayer({LayerKind::kClip, c});
        ImGui::PopID();
    }
}

void addClip(Workspace& w, const ClipDescription& clip) {
    w.scene.clips.push_back(clip);
    selectLayer({LayerKind::kClip, w.scene.clips.size() - 1});
    w.requests.scene_changed = true;
}

ClipDescription planeFor(const Workspace& w) {
    std::optional<ClipSurface> picked;
    if (!w.picks.empty()) picked = ClipSurface{w.picks.back().position, w.picks.back().normal};
    return newClipPlane(picked, axesOf(w.camera).forward, 0.5 * (w.scene_min + w.scene_max), sceneUpright(w));
}

/// A button that adds a clip, unless the scene would have too many planes.
void addClipButton(Workspace& w, const char* name, const ClipDescription& clip, const char* tip) {
    std::vector<ClipDescription> all = w.scene.clips;
    all.push_back(clip);
    ImGui::BeginDisabled(countHalfSpaces(all) > MAX_CLIP_PLANES);
    if (columnButton(name, 3, false, tip)) addClip(w, clip);
    ImGui::EndDisabled();
    ImGui::SameLine();
}

void drawClipButtons(Workspace& w) {
    addClipButton(w, "Box", newClipBox(w.scene_min, w.scene_max), "add a box around the scan, then move its sides");
    addClipButton(w, "Plane", planeFor(w),
                  "cut away what is in front of the last picked point; without one, what is above the middle");
    const LayerId selected{LayerKind::kClip, static_cast<std::size_t>(selectedClip(w))};
    ImGui::BeginDisabled(w.scene.clips.empty() || !mayDelete(w.scene, selected));
    if (columnButton("Delete", 3)) {
        deleteLayer(w.scene, selected);
        w.requests.scene_changed = true;
    }
    ImGui::EndDisabled();
}

/// Six sliders. They reach beyond the scan by a tenth of its size at both ends.
void drawBoxSides(Workspace& w, ClipBox& box) {
    constexpr const char* kNames[3][2] = {{"X from", "X to"}, {"Y from", "Y to"}, {"Z from", "Z to"}};
    const double size = sceneSize(w);
    const std::string format = lengthFormat(w, kClipLength);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool is_high : {false, true}) {
            double value = coordinate(is_high ? box.high : box.low, axis);
            const SliderRange range{coordinate(w.scene_min, axis) - 0.1 * size,
                                    coordinate(w.scene_max, axis) + 0.1 * size};
            const char* tip = "keeps what is between the two, in the scan's coordinates; Ctrl + click to type";
            if (reportSceneEdit(w, sliderRow(kNames[axis][is_high], value, range, format.c_str(), tip)))
                setBoxSide(box, axis, is_high, value, kThinnest * size);
        }
}

void drawPlaneValues(Workspace& w, ClipPlane& plane) {
    reportSceneEdit(w, pointRow("Point", plane.point, sceneSize(w), w.measure_units.unit,
                                "a point of the plane, in the scan's coordinates"));
    const struct {
        const char* name;
        Vec3 normal;
    } sides[] = {{"X", {1, 0, 0}}, {"Y", {0, 1, 0}}, {"Z", {0, 0, 1}}};
    for (const auto& side : sides) {
        const bool chosen = std::abs(dot(plane.normal, side.normal)) > 1 - 1e-9;
        if (reportSceneEdit(w, columnButton(side.name, 4, chosen, "cut square to this axis")))
            plane.normal = side.normal;
        ImGui::SameLine();
    }
    if (reportSceneEdit(w, columnButton("Flip", 4, false, "keep the other side"))) plane.normal = -1.0 * plane.normal;
}

} // namespace

void drawClips(Workspace& w) {
    drawClipList(w);
    drawClipButtons(w);
    if (w.scene.clips.empty()) return;
    const int selected = selectedClip(w);
    ImGui::PushID(selected);
    ClipDescription& clip = w.scene.clips[static_cast<std::size_t>(selected)];
    ImGui::BeginDisabled(clip.layer.locked);
    if (auto* box = std::get_if<ClipBox>(&clip.form)) drawBoxSides(w, *box);
    if (auto* plane = std::get_if<ClipPlane>(&clip.form)) drawPlaneValues(w, *plane);
    const bool has_outline = std::holds_alternative<ClipPlane>(clip.form) && !w.scene.instances.empty();
    if (has_outline &&
        columnButton("Save the outline", 1, false,
                     "the lines in which the plane cuts the scans, as DXF and SVG: a floor plan where it "
                     "is level; pointrt-rays section has more choices"))
        w.requests.save_outline = static_cast<std::size_t>(selected);
    offerHandles({LayerKind::kClip, static_cast<std::size_t>(selected)});
    ImGui::EndDisabled();
    ImGui::PopID();
}

} // namespace pointrt

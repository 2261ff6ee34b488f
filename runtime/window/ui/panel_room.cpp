// SPDX-License-Identifier: Apache-2.0
// The Room section: surroundings and up axis.
#include <imgui.h>

#include <iterator>

#include "runtime/scene/default_lighting.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

void setRoom(Workspace& w, std::optional<Room> room) {
    w.settings.room = room;
    if (!room) w.settings.lights.reset();
    w.requests.settings_changed = true;
}

void roomButton(Workspace& w, const char* name, std::optional<Room> room, const char* tip) {
    if (columnButton(name, 4, w.settings.room == room, tip)) setRoom(w, room);
}

/// In most scans Z is up, in most models Y.
void drawUp(Workspace& w) {
    const struct {
        const char* name;
        Vec3 axis;
    } sides[] = {{"X up", {1, 0, 0}},   {"Y up", {0, 1, 0}},   {"Z up", {0, 0, 1}},
                 {"-X up", {-1, 0, 0}}, {"-Y up", {0, -1, 0}}, {"-Z up", {0, 0, -1}}};
    bool first = true;
    for (const auto& side : sides) {
        if (!first) ImGui::SameLine();
        first = false;
        const bool stands = length(w.scene_up - side.axis) < 1e-6;
        if (columnButton(side.name, static_cast<int>(std::size(sides)), stands, "up axis of the scan"))
            w.requests.up = side.axis;
    }
}

} // namespace

void drawRoom(Workspace& w) {
    drawUp(w);
    roomButton(w, "Studio", std::nullopt, "three soft lamps over a matte floor");
    ImGui::SameLine();
    roomButton(w, "Matte", Room::kMatte, "a grey room with lamps");
    ImGui::SameLine();
    roomButton(w, "Mirror", Room::kMirror, "a room of mirrors with lamps");
    ImGui::SameLine();
    roomButton(w, "None", Room::kNone, "lamps only");
    if (!w.settings.room) return;
    std::uint32_t lamps = w.settings.lights.value_or(kRingLights);
    if (reportEdit(w.requests, Edit::kSettings,
                   sliderRow("Lamps", lamps, sliderRange(rowOf<&RenderSettings::lights>().limits),
                             "number of lamps on a ring above the scan, the first over your left shoulder")))
        w.settings.lights = lamps;
}

} // namespace pointrt

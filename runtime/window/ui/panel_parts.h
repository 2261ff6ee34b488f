// SPDX-License-Identifier: Apache-2.0
// The parts that drawUi (panel_ui.h) is made of.
#pragma once

#include "runtime/scene/render_setting_table.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {

/// Length of the diagonal of the scan's bounds, input units; 1 where they are none or absurd.
double sceneSize(const Workspace& w);
/// What the scene stands on: unit length.
Vec3 sceneUpright(const Workspace& w);

/// What a slider may take of a setting (render_setting_table.h).
constexpr SliderRange sliderRange(CountRange range, bool logarithmic = false) {
    return {static_cast<double>(range.low), static_cast<double>(range.high), logarithmic};
}

/// Sections of the panel, each within its header.
void drawLights(Workspace& w);
void sampleSky(Workspace& w);
void drawMaterials(Workspace& w);
void drawRoom(Workspace& w);
void drawRender(Workspace& w);
void drawPicture(Workspace& w);
void drawColors(Workspace& w);
void drawCamera(Workspace& w);
void drawViews(Workspace& w);
void drawMeasure(Workspace& w);
void drawOutput(Workspace& w);
void drawAbout(Workspace& w);

/// The values of one light.
void drawLightValues(Workspace& w, LightDescription& light);
/// Where a sun stands, by place and time. towards: unit vector to it.
void drawSunByDate(Workspace& w, Vec3& towards);
/// The values that this material's kind has.
void drawMaterialValues(Workspace& w, MaterialDescription& material);

/// The part of the window that the panel leaves free, window units from the upper left corner.
struct FreeArea {
    float width = 1, height = 1;
};

/// On the picture.
void drawPickMarks(const Workspace& w);
/// The figures in the upper left corner, and the last pick below; what is wider than the area is left out.
void drawHud(const Workspace& w, FreeArea area);
/// Rows about the last of w.picks, which must be there.
void drawLastPick(const Workspace& w);
/// What the scans' colours mean, where they are coloured; lower left corner.
void drawLegendBox(const Workspace& w, FreeArea area);
void drawCheatSheet(Workspace& w, FreeArea area);
/// The work under way, above it what there is to say; middle of the lower edge.
void drawJobAndNotices(Workspace& w, FreeArea area);
void drawEmptyState(const Workspace& w, FreeArea area);

} // namespace pointrt

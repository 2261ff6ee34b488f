// SPDX-License-Identifier: Apache-2.0
// The parts of drawUi (panel_ui.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/scene/render_setting_table.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {

/// Diagonal of the scan's bounds, input units; 1 if they are empty or absurd.
double sceneSize(const Workspace& w);
/// The up direction, unit length.
Vec3 sceneUpright(const Workspace& w);

/// The slider range for a setting's limits (render_setting_table.h).
constexpr SliderRange sliderRange(CountRange range, bool logarithmic = false) {
    return {static_cast<double>(range.low), static_cast<double>(range.high), logarithmic};
}

/// Sections of the panel, below their headers.
void drawLayers(Workspace& w);
void drawLights(Workspace& w);
void drawSky(Workspace& w);
void drawMaterials(Workspace& w);
void drawRoom(Workspace& w);
void drawRender(Workspace& w);
void drawPicture(Workspace& w);
void drawColors(Workspace& w);
void drawCamera(Workspace& w);
void drawViews(Workspace& w);
void drawClips(Workspace& w);
void drawFilters(Workspace& w);
void drawMeasure(Workspace& w);
void drawOutput(Workspace& w);
void drawAbout(Workspace& w);

/// Properties of one light.
void drawLightValues(Workspace& w, LightDescription& light);
/// Sets a sun by place and time. towards: unit vector to the sun.
void drawSunByDate(Workspace& w, Vec3& towards);
/// Properties of a material, by its kind.
void drawMaterialValues(Workspace& w, MaterialDescription& material);
/// Kind and properties of a material that shapes use, by its number in the scene.
void drawShapeMaterial(Workspace& w, std::uint32_t number);

/// The part of the window that the panel leaves free, window units from the upper left corner.
struct FreeArea {
    float width = 1, height = 1;
};

/// The handles of the selected layer, if a section shows it: arrows to drag it along the axes, arcs to rotate it about
/// them. Call it after the panel.
void drawGizmo(Workspace& w);
/// Draws the picked points and the scene's measurements over the picture.
void drawPickMarks(const Workspace& w);
/// Buttons of the most used actions, along the upper edge. Returns the lower edge.
float drawToolbar(Workspace& w, FreeArea area);
/// Statistics and the last pick, below top at the left. Boxes wider than area are omitted.
void drawHud(const Workspace& w, FreeArea area, float top);
/// Properties of the last of w.picks, which must not be empty.
void drawLastPick(const Workspace& w);
/// The legend of the current colours, if any, in the lower left corner.
void drawLegendBox(const Workspace& w, FreeArea area);
void drawCheatSheet(Workspace& w, FreeArea area);
/// All commands, found by their words.
void drawPalette(Workspace& w, FreeArea area);
/// Files to open, if w.browser is set.
void drawBrowser(Workspace& w, FreeArea area);
/// The running job, with notices above it, at the middle of the lower edge.
void drawJobAndNotices(Workspace& w, FreeArea area);
/// In the middle while no scene is open: what is being opened, or how to open something.
void drawEmptyState(Workspace& w, FreeArea area);
/// A button that leads back to the scans, if none is in view.
void drawWayBack(Workspace& w, FreeArea area);
/// The question, if any, over everything else.
void drawQuestion(Workspace& w);

} // namespace pointrt

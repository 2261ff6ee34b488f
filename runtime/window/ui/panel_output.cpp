// SPDX-License-Identifier: Apache-2.0
// The Output and About sections.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "runtime/scene/turntable.h"
#include "runtime/util/pixel_size.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

constexpr int kPictures = 36; // one per 10 degrees
constexpr std::uint32_t kMaxPictures = 3600;
static_assert(kMaxPictures <= kMaxTurntable);

/// Pictures of any size, rendered one after another while the user continues.
void drawStills(Workspace& w) {
    ImGui::TextDisabled("Stills");
    constexpr SliderRange kPixels{1, kMaxPixelSide, true};
    sliderRow("Width", w.still_size.width, kPixels, "pixels; Ctrl + click to type");
    sliderRow("Height", w.still_size.height, kPixels, "pixels; Ctrl + click to type");
    if (columnButton("Add to the queue", 2, false,
                     "renders this view in the background, with the number of samples set under Render"))
        w.requests.add_still = true;
    if (w.stills.empty()) return;
    ImGui::SameLine();
    if (columnButton("Clear", 2, false, "removes the waiting stills from the queue")) w.stills.clear();
    dimText((std::to_string(w.stills.size()) + " waiting").c_str());
}

} // namespace

void drawOutput(Workspace& w) {
    if (columnButton("Save scene", 1, false, "Ctrl + S: save a scene file that renders this picture with pointrt-view"))
        w.requests.save_scene = true;
    drawStills(w);
    ImGui::TextDisabled("Turntable");
    auto pictures = static_cast<std::uint32_t>(std::max(1, storedInt("turntable pictures", kPictures)));
    if (sliderRow("Pictures", pictures, {1, kMaxPictures, true}, "for one turn about the up axis"))
        storedInt("turntable pictures", kPictures) = static_cast<int>(pictures);
    textRow("Files", w.turntable_path, "%04d.png",
            "%04d is replaced by the picture's number; a name that ends in .mp4 or .webm makes a video, if ffmpeg is "
            "installed");
    ImGui::BeginDisabled(w.job.has_value() || w.turntable_path.empty());
    if (columnButton("Turntable", 2, false, "circles the target once")) w.requests.turntable_pictures = pictures;
    ImGui::SameLine();
    ImGui::BeginDisabled(w.scene.views.size() < 2);
    if (columnButton("Path", 2, false, "moves smoothly through the list of views, at least two")) {
        w.requests.turntable_pictures = pictures;
        w.requests.follows_views = true;
    }
    ImGui::EndDisabled();
    ImGui::EndDisabled();
}

void drawAbout(Workspace& w) {
    checkboxRow("Light theme", w.light_theme,
                "light colours for the panel; remembered for the next start, like the open sections");
    checkboxRow("Statistics", w.show_hud, "device, samples and speed in the upper left corner");
    if (columnButton("All controls", 1, w.show_cheat_sheet, "H")) w.show_cheat_sheet = !w.show_cheat_sheet;
    if (!w.hud.device.empty()) dimText(w.hud.device.c_str());
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Picture section.
#include <imgui.h>

#include <array>

#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_lengths.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

constexpr auto kShown = [] {
    std::array<const char*, kFilmViews.size()> labels{};
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = kFilmViews[i].label;
    return labels;
}();

/// The range in which a slider is precise enough.
constexpr SliderRange kExposures{-8, 8};
static_assert(rowOf<&RenderSettings::exposure>().limits.low <= kExposures.low &&
              kExposures.high <= rowOf<&RenderSettings::exposure>().limits.high);

} // namespace

void drawPicture(Workspace& w) {
    const auto note = [&](bool changed) { return reportEdit(w.requests, Edit::kLook, changed); };
    note(sliderRow("Exposure", w.look.exposure, kExposures, "%+.2f stops", "one stop doubles the brightness"));
    note(checkboxRow("Denoise", w.denoise, "filter the noise of unfinished pictures"));
    int shown = static_cast<int>(w.look.shown);
    if (note(comboRow("Show", shown, kShown, "the picture, or one of its layers")))
        w.look.shown = static_cast<std::uint32_t>(shown);
    if (w.look.shown == SHOWN_DEPTH)
        note(sliderRow("Black at", w.look.depth_black, {1e-2 * sceneSize(w), 1e2 * sceneSize(w), true},
                       lengthFormat(w, "%.4g").c_str(), "distance from the eye shown as black, scene units"));
    if (columnButton("Save picture", 1, false, "F12: PNG and EXR")) w.requests.screenshot = true;
}

} // namespace pointrt

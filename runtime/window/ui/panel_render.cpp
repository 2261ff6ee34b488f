// SPDX-License-Identifier: Apache-2.0
// The Render section.
#include <imgui.h>

#include <algorithm>
#include <array>

#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

constexpr auto kLabels = [] {
    std::array<const char*, kIntegrators.size()> labels{};
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = kIntegrators[i].label;
    return labels;
}();

} // namespace

void drawRender(Workspace& w) {
    RenderSettings& settings = w.settings;
    const auto note = [&](bool changed) { return reportEdit(w.requests, Edit::kSettings, changed); };
    int integrator = static_cast<int>(settings.integrator);
    if (note(comboRow("Light", integrator, kLabels,
                      "direct light: fast; with mirrors: adds reflection and refraction; full light: adds light "
                      "scattered between surfaces; without lamps: the scan's colours, darkened in hollows")))
        settings.integrator = static_cast<Integrator>(integrator);
    ImGui::BeginDisabled(!hasTrait(settings.integrator, INTEGRATOR_HAS_BOUNCES));
    note(sliderRow("Bounces", settings.bounces, sliderRange(rowOf<&RenderSettings::bounces>().limits, true),
                   "maximum number of bounces of a path"));
    note(checkboxRow("Caustics", settings.caustics, "light focused by glass and mirrors"));
    ImGui::EndDisabled();
    note(checkboxRow("Shadows", settings.shadows));
    note(checkboxRow("Blend", settings.blend, "blend splats into a smooth surface; off: flat discs"));
    constexpr RealRange kSizes = rowOf<&RenderSettings::splat_size>().limits;
    note(sliderRow("Splat size", settings.splat_size, {double{kSizes.low}, double{kSizes.high}}, "%.2f",
                   "scales the radii of splats; small values show single points"));
    reportEdit(w.requests, Edit::kLook,
               sliderRow("Samples", w.target_samples, sliderRange(rowOf<&RenderSettings::spp>().limits, true),
                         "per pixel, when the picture is finished"));
    reportEdit(w.requests, Edit::kLook, checkboxRow("Pause", w.paused, "Space"));
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The Sky section.
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

constexpr SliderRange kStrengths{1e-3, 1e3, true};

/// A colour picker for light, whose channels may exceed 1: the maximum is kept.
bool lightRow(const char* name, Color& color, const char* tip) {
    const float most = std::max({1.0f, color[0], color[1], color[2]});
    Color shown = {color[0] / most, color[1] / most, color[2] / most};
    if (!colorRow(name, shown, tip)) return false;
    color = {shown[0] * most, shown[1] * most, shown[2] * most};
    return true;
}

} // namespace

void drawSky(Workspace& w) {
    SkyDescription sky = w.scene.sky.value_or(SkyDescription{});
    bool changed = false;
    const auto note = [&](bool edited) { changed |= reportEdit(w.requests, Edit::kScene, edited); };
    if (sky.image.empty()) {
        note(lightRow("Above", sky.zenith, "the colour straight up"));
        note(lightRow("Horizon", sky.horizon, "the colour at eye level"));
        note(lightRow("Below", sky.ground, "the colour straight down"));
    } else {
        valueRow("Picture", std::filesystem::path(sky.image).filename().string().c_str());
        note(sliderRow("Rotation", sky.rotation_deg, {-360, 360}, "%.1f\xC2\xB0", "about the up axis"));
    }
    note(sliderRow("Strength", sky.strength, kStrengths, "%.3f", "multiplies the sky's light"));
    note(sliderRow("Ambient", sky.ambient, {0, 1}, "%.2f",
                   "share of the sky's light that reaches shadows; not used with full light, which computes it"));
    if (changed) w.scene.sky = sky;
}

} // namespace pointrt

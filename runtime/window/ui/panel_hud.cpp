// SPDX-License-Identifier: Apache-2.0
// Statistics in the corner of the picture.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/window/ui/panel_box.h"
#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kHudMargin = 10, kHudWidth = 236, kPickWidth = 300, kHudBarHeight = 3;

/// Progress towards the target samples, 0 to 1.
float sampleShare(const HudStats& hud) {
    if (hud.target_samples == 0) return 0;
    const double done = hud.samples + (std::isfinite(hud.sample_share) ? hud.sample_share : 0);
    return static_cast<float>(std::clamp(done / hud.target_samples, 0.0, 1.0));
}

void drawSamples(const Workspace& w) {
    const char* state = w.paused ? "paused" : w.hud.resting ? "done" : "";
    ImGui::Text("%s of %s samples  %s", countText(w.hud.samples).c_str(), countText(w.hud.target_samples).c_str(),
                state);
    ImGui::ProgressBar(sampleShare(w.hud), ImVec2(-1, kHudBarHeight * uiScale()), "");
}

/// Device names are long; their ends, which matter least, are cut off.
void drawDevice(const HudStats& hud) {
    constexpr int most = 34;
    ImGui::TextDisabled("%.*s%s", most, hud.device.c_str(), hud.device.size() > most ? "..." : "");
}

void drawStats(const Workspace& w) {
    const HudStats& hud = w.hud;
    drawDevice(hud);
    if (hud.splats > 0) ImGui::Text("%s splats", countText(hud.splats).c_str());
    if (hud.tiles > 0)
        ImGui::Text("%s of %s tiles%s", countText(hud.tiles).c_str(), countText(hud.target_tiles).c_str(),
                    hud.tiles_loading ? ", loading" : "");
    ImGui::Text("%u x %u pixels", hud.picture_width, hud.picture_height);
    drawSamples(w);
    ImGui::Text("%.3g ms   %.3g Mrays/s   %s", hud.frame_ms, hud.mrays_per_second, bytesText(hud.device_bytes).c_str());
}

/// A box without mouse input, below top; returns its lower edge.
float drawBox(const char* name, float top, float width, const std::function<void()>& content) {
    constexpr ImGuiWindowFlags through = ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::SetNextWindowBgAlpha(0.6f);
    return top +
           boxOnPicture(name, {ImVec2(kHudMargin * uiScale(), top), ImVec2(0, 0)}, width * uiScale(), through, content);
}

} // namespace

void drawHud(const Workspace& w, FreeArea area, float top) {
    const float margin = kHudMargin * uiScale(), width = area.width / uiScale() - kHudMargin;
    if (width < kHudWidth || w.hud.picture_width == 0) return;
    const float bottom = drawBox("Statistics", top + margin, kHudWidth, [&] { drawStats(w); });
    if (!w.picks.empty() && width >= kPickWidth) drawBox("Pick", bottom + margin, kPickWidth, [&] { drawLastPick(w); });
}

} // namespace pointrt

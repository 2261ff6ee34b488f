// SPDX-License-Identifier: Apache-2.0
// The Colours section.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"

namespace pointrt {
namespace {

bool noteColors(Workspace& w, bool changed) { return reportEdit(w.requests, Edit::kSettings, changed); }

constexpr auto kMapLabels = [] {
    std::array<const char*, 1 + kColorMapNames.size()> labels{"automatic"};
    for (std::size_t i = 0; i < kColorMapNames.size(); ++i) labels[1 + i] = kColorMapNames[i].name;
    return labels;
}();

/// Off, in the window only, or in saved pictures as well.
constexpr std::array kLegendLabels = {"off", "in the window", "in PNGs too"};

void drawAttributeChoice(Workspace& w) {
    std::vector<const char*> words;
    for (const std::string& word : w.color_words) words.push_back(word.c_str());
    const auto current = std::find(w.color_words.begin(), w.color_words.end(), w.settings.color_by);
    int chosen = current == w.color_words.end() ? -1 : static_cast<int>(current - w.color_words.begin());
    if (!noteColors(w, comboRow("Colour by", chosen, words, "rgb: the scan's own colours"))) return;
    w.settings.color_by = w.color_words[static_cast<std::size_t>(chosen)];
    w.settings.color_map.reset(); // map and range were chosen for other values
    w.settings.color_range.reset();
}

void drawMap(Workspace& w) {
    int chosen = w.settings.color_map ? 1 + static_cast<int>(*w.settings.color_map) : 0;
    if (!noteColors(w, comboRow("Map", chosen, kMapLabels, "classes and scans suit integer values"))) return;
    w.settings.color_map.reset();
    if (chosen > 0) w.settings.color_map = kColorMapNames[static_cast<std::size_t>(chosen) - 1].value;
}

/// Beyond this, drag steps are lost in rounding.
constexpr double kLargest = 1e15;

void drawRange(Workspace& w) {
    const ValueRange shown = w.settings.color_range.value_or(w.legend->range);
    const double step = std::max((shown.high - shown.low) / 200, 1e-9); // a drag across the panel covers the range
    ValueRange range = shown;
    bool changed = noteColors(w, dragRow("From", range.low, {-kLargest, kLargest}, step, "%.6g",
                                         "value with the map's first colour; double-click to type"));
    changed |= noteColors(
        w, dragRow("To", range.high, {-kLargest, kLargest}, step, "%.6g", "value with the map's last colour"));
    if (changed && range.low < range.high) w.settings.color_range = range;
    ImGui::BeginDisabled(!w.settings.color_range);
    if (columnButton("Reset range", 1, false,
                     "back to the automatic range: 1st to 99th percentile, or all small integers")) {
        w.settings.color_range.reset();
        w.requests.settings_changed = true;
    }
    ImGui::EndDisabled();
}

void drawLegendChoice(Workspace& w) {
    int chosen = w.settings.legend ? (*w.settings.legend ? 2 : 0) : 1;
    if (!reportEdit(w.requests, Edit::kLook, comboRow("Legend", chosen, kLegendLabels, "explains the colours"))) return;
    w.settings.legend.reset();
    if (chosen != 1) w.settings.legend = chosen == 2;
}

} // namespace

void drawColors(Workspace& w) {
    drawAttributeChoice(w);
    if (w.settings.color_by == kOwnColors || w.settings.color_by == "normal") return;
    drawMap(w);
    if (w.legend && !w.legend->bar.empty()) drawRange(w);
    drawLegendChoice(w);
}

} // namespace pointrt

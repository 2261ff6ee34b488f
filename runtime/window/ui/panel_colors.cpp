// SPDX-License-Identifier: Apache-2.0
// What scans are coloured by.
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
    std::array<const char*, 1 + kColorMapNames.size()> labels{"as fits"};
    for (std::size_t i = 0; i < kColorMapNames.size(); ++i) labels[1 + i] = kColorMapNames[i].name;
    return labels;
}();

/// Off, in the window, and in pictures that are saved as well.
constexpr std::array kLegendLabels = {"off", "in the window", "in PNGs too"};

void drawAttributeChoice(Workspace& w) {
    std::vector<const char*> words;
    for (const std::string& word : w.color_words) words.push_back(word.c_str());
    const auto known = std::find(w.color_words.begin(), w.color_words.end(), w.settings.color_by);
    int chosen = known == w.color_words.end() ? -1 : static_cast<int>(known - w.color_words.begin());
    if (!noteColors(w, comboRow("Colour by", chosen, words, "rgb: their own colours"))) return;
    w.settings.color_by = w.color_words[static_cast<std::size_t>(chosen)];
    w.settings.color_map.reset(); // what was said of other numbers
    w.settings.color_range.reset();
}

void drawMap(Workspace& w) {
    int chosen = w.settings.color_map ? 1 + static_cast<int>(*w.settings.color_map) : 0;
    if (!noteColors(w, comboRow("Map", chosen, kMapLabels, "classes and scans are for whole numbers"))) return;
    w.settings.color_map.reset();
    if (chosen > 0) w.settings.color_map = kColorMapNames[static_cast<std::size_t>(chosen) - 1].value;
}

/// Below any numbers that steps make sense for.
constexpr double kLargest = 1e15;

void drawRange(Workspace& w) {
    const ValueRange shown = w.settings.color_range.value_or(w.legend->range);
    const double step = std::max((shown.high - shown.low) / 200, 1e-9); // a drag over the panel goes through all of it
    ValueRange range = shown;
    bool changed = noteColors(w, dragRow("From", range.low, {-kLargest, kLargest}, step, "%.6g",
                                         "the number that gets the map's first colour; double click to type"));
    changed |= noteColors(
        w, dragRow("To", range.high, {-kLargest, kLargest}, step, "%.6g", "the number that gets its last colour"));
    if (changed && range.low < range.high) w.settings.color_range = range;
    ImGui::BeginDisabled(!w.settings.color_range);
    if (columnButton("Range of the numbers", 1, false, "without the lowest and the highest percent")) {
        w.settings.color_range.reset();
        w.requests.settings_changed = true;
    }
    ImGui::EndDisabled();
}

void drawLegendChoice(Workspace& w) {
    int chosen = w.settings.legend ? (*w.settings.legend ? 2 : 0) : 1;
    if (!reportEdit(w.requests, Edit::kLook, comboRow("Legend", chosen, kLegendLabels, "what the colours mean")))
        return;
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

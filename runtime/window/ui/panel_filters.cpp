// SPDX-License-Identifier: Apache-2.0
// The Filter section: which values of an attribute are shown.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/point_classes.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Height of a histogram in lines of text.
constexpr float kHistogramLines = 3;

/// The attributes to filter by: the numeric ones of the attributes to colour by.
std::vector<std::string> filterWords(const Workspace& w) {
    std::vector<std::string> words;
    std::copy_if(w.color_words.begin(), w.color_words.end(), std::back_inserter(words),
                 [](const std::string& word) { return word != kOwnColors && word != "normal"; });
    return words;
}

void drawFilterChoice(Workspace& w) {
    const std::vector<std::string> words = filterWords(w);
    if (words.empty()) return dimText("The open scans have no attributes to filter by.");
    std::vector<const char*> names;
    for (const std::string& word : words) names.push_back(word.c_str());
    int chosen = -1;
    if (!comboRow("Add", chosen, names, "show only points with certain values of an attribute")) return;
    w.scene.filters.push_back({{words[static_cast<std::size_t>(chosen)], {}}, true, ""});
    w.requests.scene_changed = true;
}

std::string valueName(const std::string& word, double value) {
    const bool is_byte = value >= 0 && value <= 255;
    if (attributeWord(word) == "classification" && is_byte) return className(static_cast<std::uint8_t>(value));
    return std::to_string(static_cast<long long>(value));
}

bool selects(const SplatSelection& selection, double value) {
    return selection.ranges.empty() || holdsNumber(selection.ranges, value);
}

/// A check mark for each value.
void drawValues(Workspace& w, SplatSelection& selection, const std::vector<double>& values) {
    for (const double value : values) {
        bool shown = selects(selection, value);
        const std::string name = valueName(selection.attribute, value);
        if (!reportSceneEdit(w, ImGui::Checkbox(name.c_str(), &shown))) continue;
        std::vector<ValueRange> ranges;
        for (const double each : values)
            if (each == value ? shown : selects(selection, each)) ranges.push_back({each, each});
        // a filter without ranges would hide nothing: if none is left, a value that no point has hides everything
        if (ranges.empty()) ranges.push_back({values.back() + 1, values.back() + 1});
        selection.ranges = std::move(ranges);
    }
}

/// The end of the range that is nearer to a number.
double& nearerEnd(ValueRange& range, double number) {
    return std::abs(number - range.low) < std::abs(number - range.high) ? range.low : range.high;
}

/// Bars, bright for shown values. Dragging moves the nearer end of the range.
bool drawHistogram(const NumberHistogram& histogram, ValueRange& range) {
    const ImVec2 size{ImGui::GetContentRegionAvail().x, kHistogramLines * ImGui::GetTextLineHeight()};
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##histogram", size);
    const double low = histogram.range.low, width = histogram.range.high - low;
    const float bar = size.x / static_cast<float>(kHistogramBins);
    for (std::size_t i = 0; i < histogram.shares.size(); ++i) {
        const double number = low + (static_cast<double>(i) + 0.5) / double{kHistogramBins} * width;
        const bool shown = range.low <= number && number <= range.high;
        const float left = corner.x + static_cast<float>(i) * bar, bottom = corner.y + size.y;
        ImGui::GetWindowDrawList()->AddRectFilled(
            {left, bottom - std::sqrt(histogram.shares[i]) * size.y}, {left + bar, bottom},
            ImGui::GetColorU32(shown ? ImGuiCol_PlotHistogram : ImGuiCol_FrameBg));
    }
    if (!ImGui::IsItemActive() || !(width > 0)) return false;
    const double share = std::clamp((ImGui::GetIO().MousePos.x - corner.x) / size.x, 0.0f, 1.0f);
    const double number = low + share * width;
    double& end = nearerEnd(range, number);
    return std::exchange(end, number) != number;
}

void drawRangeEnds(Workspace& w, SplatSelection& selection, const NumberHistogram& histogram) {
    ValueRange range = selection.ranges.empty() ? histogram.range : selection.ranges.front();
    bool changed = reportSceneEdit(w, drawHistogram(histogram, range));
    tooltip("drag an end of the range");
    const SliderRange limits{histogram.range.low, histogram.range.high};
    const char* const from_tip = "the lowest number shown; Ctrl + click to type";
    changed |= reportSceneEdit(w, sliderRow("From", range.low, limits, "%.6g", from_tip));
    changed |= reportSceneEdit(w, sliderRow("To", range.high, limits, "%.6g", "the highest number shown"));
    if (changed) selection.ranges = {{std::min(range.low, range.high), std::max(range.low, range.high)}};
}

void drawFilter(Workspace& w, FilterDescription& filter) {
    SplatSelection& selection = filter.shown;
    reportSceneEdit(w, checkboxRow(selection.attribute.c_str(), filter.enabled, "turn this filter on or off"));
    const auto found = w.histograms.find(selection.attribute);
    if (found == w.histograms.end()) return;
    const NumberHistogram& histogram = found->second;
    ImGui::BeginDisabled(!filter.enabled);
    if (histogram.values.empty())
        drawRangeEnds(w, selection, histogram);
    else
        drawValues(w, selection, histogram.values);
    ImGui::EndDisabled();
}

} // namespace

void drawFilters(Workspace& w) {
    std::vector<FilterDescription>& filters = w.scene.filters;
    for (std::size_t i = 0; i < filters.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        drawFilter(w, filters[i]);
        const bool deletes = columnButton("Delete", 2);
        ImGui::PopID();
        if (!deletes) continue;
        filters.erase(filters.begin() + static_cast<std::ptrdiff_t>(i--));
        w.requests.scene_changed = true;
    }
    drawFilterChoice(w);
}

} // namespace pointrt

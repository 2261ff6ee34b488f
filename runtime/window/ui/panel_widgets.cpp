// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_widgets.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Width of labels, design units.
constexpr float kNameWidth = 92;

/// Runs widget on value (which may be NaN) and accepts a result if it is finite, clamped to range.
template <typename T, typename Widget>
bool edited(T& value, SliderRange range, const Widget& widget) {
    T shown = std::isfinite(value) ? value : static_cast<T>(range.low);
    if (!widget(shown) || !std::isfinite(shown)) return false;
    value = std::clamp(shown, static_cast<T>(range.low), static_cast<T>(range.high));
    return true;
}

int flagsOf(SliderRange range) {
    return ImGuiSliderFlags_AlwaysClamp | (range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

template <typename T>
bool slide(const char* name, T& value, ImGuiDataType type, SliderRange range, const char* format, const char* tip) {
    pushRow(name, tip);
    const T low = static_cast<T>(range.low), high = static_cast<T>(range.high);
    const bool changed = edited(value, range, [&](T& shown) {
        return ImGui::SliderScalar("##value", type, &shown, &low, &high, format, flagsOf(range));
    });
    tooltip(tip);
    popRow();
    return changed;
}

/// Limits of scene files.
constexpr SliderRange kCoordinates{-1e12, 1e12};

bool dragOf(const char* id, double& value, double step, const char* format) {
    return edited(value, kCoordinates, [&](double& shown) {
        return ImGui::DragScalar(id, ImGuiDataType_Double, &shown, static_cast<float>(step), &kCoordinates.low,
                                 &kCoordinates.high, format, ImGuiSliderFlags_NoRoundToFormat);
    });
}

float encoded(float linear) {
    const float value = std::max(0.0f, std::min(linear, 1.0f));
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

float decoded(float value) { return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f); }

} // namespace

void tooltip(const char* tip) {
    if (*tip == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
    constexpr float patience_s = 0.5f; // delay of tooltips, which cover the rows below
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.HoveredId != 0 && context.HoveredIdTimer < patience_s) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(18 * ImGui::GetFontSize());
    ImGui::TextUnformatted(tip);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void pushRow(const char* name, const char* tip) {
    ImGui::PushID(name);
    const float left = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name);
    tooltip(tip);
    ImGui::SameLine(left + kNameWidth * uiScale());
    ImGui::SetNextItemWidth(-1);
}

void popRow() { ImGui::PopID(); }

bool sliderRow(const char* name, float& value, SliderRange range, const char* format, const char* tip) {
    return slide(name, value, ImGuiDataType_Float, range, format, tip);
}

bool sliderRow(const char* name, double& value, SliderRange range, const char* format, const char* tip) {
    return slide(name, value, ImGuiDataType_Double, range, format, tip);
}

bool sliderRow(const char* name, std::uint32_t& value, SliderRange range, const char* tip) {
    return slide(name, value, ImGuiDataType_U32, range, "%u", tip);
}

bool dragRow(const char* name, double& value, SliderRange range, double step, const char* format, const char* tip) {
    pushRow(name, tip);
    const bool changed = edited(value, range, [&](double& shown) {
        return ImGui::DragScalar("##value", ImGuiDataType_Double, &shown, static_cast<float>(step), &range.low,
                                 &range.high, format, flagsOf(range) | ImGuiSliderFlags_NoRoundToFormat);
    });
    tooltip(tip);
    popRow();
    return changed;
}

bool pointRow(const char* name, Vec3& point, double size, const std::string& unit, const char* tip) {
    constexpr double steps_in_scene = 500; // about the number of window units that a scene takes on the screen
    ImGui::PushID(name);
    ImGui::TextUnformatted((unit.empty() ? name : name + (" (" + unit + ")")).c_str());
    tooltip(tip);
    const std::string format = std::string("%.") + std::to_string(decimalsFor(size)) + "f";
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    ImGui::BeginGroup();
    bool changed = false;
    for (auto [id, value] : {std::pair{"##x", &point.x}, {"##y", &point.y}, {"##z", &point.z}}) {
        if (value != &point.x) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(std::max(1.0f, width));
        changed |= dragOf(id, *value, size / steps_in_scene, format.c_str());
        tooltip("drag, or double-click to type");
    }
    ImGui::EndGroup();
    ImGui::PopID();
    return changed;
}

Color encodedColor(const Color& linear) { return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])}; }

bool colorRow(const char* name, Color& color, const char* tip) {
    pushRow(name, tip);
    Color shown = encodedColor(color);
    const bool changed = ImGui::ColorEdit3("##value", shown.data(), ImGuiColorEditFlags_DisplayHex);
    if (changed) color = {decoded(shown[0]), decoded(shown[1]), decoded(shown[2])};
    popRow();
    return changed;
}

bool checkboxRow(const char* name, bool& value, const char* tip) {
    pushRow(name, tip);
    const bool changed = ImGui::Checkbox("##value", &value);
    tooltip(tip);
    popRow();
    return changed;
}

bool comboRow(const char* name, int& chosen, std::span<const char* const> names, const char* tip) {
    pushRow(name, tip);
    const int count = static_cast<int>(names.size());
    bool changed = false;
    if (ImGui::BeginCombo("##value", chosen >= 0 && chosen < count ? names[static_cast<std::size_t>(chosen)] : "")) {
        for (int n = 0; n < count; ++n) {
            if (!ImGui::Selectable(names[static_cast<std::size_t>(n)], n == chosen) || n == chosen) continue;
            chosen = n;
            changed = true;
        }
        ImGui::EndCombo();
    }
    tooltip(tip);
    popRow();
    return changed;
}

bool textRow(const char* name, std::string& text, const char* hint, const char* tip) {
    pushRow(name, tip);
    const bool changed = ImGui::InputTextWithHint("##value", hint, &text);
    tooltip(tip);
    popRow();
    return changed;
}

void valueRow(const char* name, const char* value) {
    pushRow(name, "");
    if (ImGui::CalcTextSize(value).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    ImGui::TextWrapped("%s", value);
    popRow();
}

bool columnButton(const char* name, int share, bool chosen, const char* tip) {
    const float gaps = static_cast<float>(share - 1) * ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorStartPos().x - gaps);
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    const bool pressed = ImGui::Button(name, ImVec2(std::max(1.0f, width / static_cast<float>(share)), 0));
    if (chosen) ImGui::PopStyleColor();
    tooltip(tip);
    return pressed;
}

void dimText(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/ui_style.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "format/os/desktop.h"

namespace pointrt {
namespace {

/// Dear ImGui's built-in font is a 13-pixel bitmap.
constexpr float kBitmapHeight = 13;

/// False if the system has none; Dear ImGui has a built-in one.
bool addOutlineFont(ImFontAtlas& atlas, float pixels) {
    for (const std::string& path : interfaceFonts()) {
        std::error_code missing;
        if (std::filesystem::is_regular_file(path, missing) && atlas.AddFontFromFileTTF(path.c_str(), pixels))
            return true;
    }
    return false;
}

/// Uses the line height of the other fonts, so that the layout is the same.
void addBitmapFont(ImFontAtlas& atlas, float pixels) {
    ImFontConfig config;
    config.SizePixels = pixels * kBitmapHeight / kTextHeight;
    config.GlyphOffset.y = 0.5f * (pixels - config.SizePixels);
    ImFont* font = atlas.AddFontDefault(&config);
    atlas.Build();
#if IMGUI_VERSION_NUM >= 19200 // the font size is set at drawing time
    font->LegacySize = pixels;
#else
    font->FontSize = pixels;
#endif
}

void setUpFont(float pixels, float pixels_per_unit) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    if (!addOutlineFont(*io.Fonts, pixels)) addBitmapFont(*io.Fonts, pixels);
    io.FontGlobalScale = 1 / pixels_per_unit;
}

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

/// Light colours are the dark ones inverted, with lighter surfaces, like paper.
ImVec4 lightened(const ImVec4& dark) {
    constexpr float kPaper = 1.07f;
    const auto turned = [](float value) { return std::clamp(kPaper - value, 0.0f, 1.0f); };
    return {turned(dark.x), turned(dark.y), turned(dark.z), dark.w};
}

bool isGrey(const ImVec4& color) { return color.x == color.y && color.y == color.z; }

/// The accent colour: for things that are selected, held or in progress.
ImVec4 accent(float alpha) { return {0.36f, 0.62f, 0.80f, alpha}; }

void setSurfaces(ImVec4* colors) {
    colors[ImGuiCol_Text] = grey(0.88f);
    colors[ImGuiCol_TextDisabled] = grey(0.54f);
    colors[ImGuiCol_TextSelectedBg] = accent(0.45f);
    colors[ImGuiCol_WindowBg] = grey(0.115f, 0.96f);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = grey(0.15f, 0.98f);
    colors[ImGuiCol_ChildBg] = grey(0.09f, 0.6f);
    colors[ImGuiCol_PopupBg] = grey(0.13f, 0.98f);
    colors[ImGuiCol_ModalWindowDimBg] = grey(0, 0.5f);
    colors[ImGuiCol_Border] = grey(0.26f, 0.7f);
    colors[ImGuiCol_Separator] = grey(0.26f, 0.7f);
    colors[ImGuiCol_ScrollbarBg] = grey(0, 0);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.30f);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.38f);
    colors[ImGuiCol_ScrollbarGrabActive] = accent(0.8f);
}

void setControls(ImVec4* colors) {
    colors[ImGuiCol_FrameBg] = grey(0.20f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.245f);
    colors[ImGuiCol_FrameBgActive] = grey(0.27f);
    colors[ImGuiCol_Button] = grey(0.22f);
    colors[ImGuiCol_ButtonHovered] = grey(0.29f);
    colors[ImGuiCol_ButtonActive] = accent(0.75f);
    colors[ImGuiCol_Header] = grey(0.185f);
    colors[ImGuiCol_HeaderHovered] = grey(0.25f);
    colors[ImGuiCol_HeaderActive] = accent(0.55f);
    colors[ImGuiCol_CheckMark] = accent(1);
    colors[ImGuiCol_SliderGrab] = accent(0.55f); // translucent, since numbers are drawn on top
    colors[ImGuiCol_SliderGrabActive] = accent(0.8f);
    colors[ImGuiCol_PlotHistogram] = accent(0.9f);
    colors[ImGuiCol_NavHighlight] = accent(1);
}

void setShapes(ImGuiStyle& style) {
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 3};
    style.ItemSpacing = {6, 5};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 9;
    style.WindowBorderSize = 0;
    style.WindowRounding = 6;
    style.ChildRounding = style.FrameRounding = style.PopupRounding = 4;
    style.ScrollbarRounding = style.GrabRounding = 4;
}

} // namespace

void setUiTheme(bool light) {
    ImGui::StyleColorsDark();
    ImVec4* const colors = ImGui::GetStyle().Colors;
    setSurfaces(colors);
    setControls(colors);
    for (int i = 0; i < ImGuiCol_COUNT && light; ++i)
        if (isGrey(colors[i]) && i != ImGuiCol_ModalWindowDimBg) colors[i] = lightened(colors[i]);
}

void setUpUiStyle(float content_scale, float pixels_per_unit) {
    // argument order turns NaN into the minimum
    const float scale = std::max(0.5f, std::min(content_scale, 4.0f));
    const float pixels = std::max(0.5f, std::min(pixels_per_unit, 4.0f));
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    setUpFont(std::round(kTextHeight * scale), pixels);
    ImGuiStyle style;
    setShapes(style);
    style.ScaleAllSizes(scale / pixels);
    ImGui::GetStyle() = style;
    setUiTheme(false);
}

float uiScale() { return ImGui::GetFontSize() / kTextHeight; }

} // namespace pointrt

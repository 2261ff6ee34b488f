// SPDX-License-Identifier: Apache-2.0
// Drives the user interface without a window: frames, and a mouse that finds widgets.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <initializer_list>
#include <optional>
#include <string>

#include "runtime/window/ui/panel_ui.h"
#include "runtime/window/ui/ui_input.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {

/// A component of a widget's id: a string or a number.
struct IdStep {
    IdStep(const char* name) : text(name) {}
    IdStep(int n) : number(n) {}
    const char* text = nullptr;
    int number = 0;
};

/// Owns an ImGui context.
class PanelDriver {
public:
    explicit PanelDriver(float width = 1280, float height = 3000) {
        ImGui::CreateContext();
        setUpUiInput();
        setUpUiStyle(1);
        unsigned char* texels = nullptr;
        int w = 0, h = 0;
        ImGuiIO& io = ImGui::GetIO();
        io.Fonts->GetTexDataAsAlpha8(&texels, &w, &h);
        io.DisplaySize = {width, height};
        io.DeltaTime = 0.02f;
        io.MousePos = {-1, -1};
    }
    ~PanelDriver() { ImGui::DestroyContext(); }
    PanelDriver(const PanelDriver&) = delete;
    PanelDriver& operator=(const PanelDriver&) = delete;

    /// Draws a frame and returns its requests.
    Requests frame(Workspace& w) {
        w.requests = {};
        ImGui::NewFrame();
        drawUi(w);
        ImGui::Render();
        return w.requests;
    }

    /// Opens or closes a section. Requires that a frame has been drawn.
    static void open(const char* section, bool open = true) {
        ImGuiWindow* panel = ImGui::FindWindowByName("Panel");
        if (!panel) return; // nothing is displayed
        panel->StateStorage.SetInt(panel->GetID(section), open ? 1 : 0);
    }
    void openAll(Workspace& w) {
        frame(w);
        for (const char* name : {"Layers", "Light", "Sky", "Materials", "Room", "Render", "Picture", "Colours",
                                 "Camera", "Views", "Clip", "Measure", "Output", "About"})
            open(name);
    }

    /// Moves the mouse over the window until it hovers over the widget.
    bool find(Workspace& w, const char* window, std::initializer_list<IdStep> path) {
        for (int f = 0; f < 3; ++f) frame(w); // until window sizes are known
        const ImGuiWindow* owner = ImGui::FindWindowByName(window);
        if (!owner) return false;
        const ImGuiID id = idOf(owner->ID, path);
        const ImRect area = owner->Rect();
        constexpr float column = 12, row = 7; // smaller than any widget
        for (float y = area.Min.y + 2; y < area.Max.y; y += row)
            for (float x = area.Min.x + 2; x < area.Max.x; x += column) {
                ImGui::GetIO().MousePos = {x, y};
                frame(w);
                if (GImGui->HoveredId == id) return true;
            }
        return false;
    }

    Requests press(Workspace& w) { return button(w, true); }
    Requests release(Workspace& w) { return button(w, false); }
    Requests move(Workspace& w, float dx) {
        ImGui::GetIO().MousePos.x += dx;
        return frame(w);
    }
    /// Returns the requests of the release.
    Requests click(Workspace& w) {
        press(w);
        return release(w);
    }

    /// The full name of a child window, from the prefix given by its owner.
    static std::string childOf(const char* beginning) {
        for (const ImGuiWindow* window : GImGui->Windows)
            if (std::string(window->Name).starts_with(beginning)) return window->Name;
        return {};
    }
    void hold(Key key, bool down) { feedImGui(input_, KeyEvent{key, down}); }
    /// Presses a key and releases it. Returns the requests of the press.
    Requests hit(Workspace& w, Key key) {
        hold(key, true);
        const Requests requests = frame(w);
        input_ = {};
        hold(key, false);
        return requests;
    }

private:
    static ImGuiID idOf(ImGuiID seed, std::initializer_list<IdStep> path) {
        for (const IdStep& step : path)
            seed = step.text ? ImHashStr(step.text, 0, seed) : ImHashData(&step.number, sizeof step.number, seed);
        return seed;
    }
    UiInput input_;
    Requests button(Workspace& w, bool down) {
        ImGui::GetIO().MouseDown[0] = down;
        return frame(w);
    }
};

} // namespace pointrt

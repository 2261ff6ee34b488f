// SPDX-License-Identifier: Apache-2.0
// The user interface of a host: Dear ImGui's input and drawing.
#pragma once

#include <vector>

#include "runtime/window/app/host.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/commands.h"
#include "runtime/window/ui/ui_input.h"

struct ImGuiContext;

namespace pointrt {

/// Owns the Dear ImGui context.
class UserInterface {
public:
    /// host must outlive it.
    explicit UserInterface(Host& host);
    ~UserInterface();
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;

    /// Passes event to the panels; returns the commands of an event that they do not use.
    std::vector<Command> handleEvent(const InputEvent& event, double now_s);
    bool isDragging() const { return controls_.drag.has_value(); }

    /// Draws the panels, which write the user's requests to work. seconds: since the last frame.
    void draw(Workspace& work, double seconds);
    /// Presents the picture with the panels on top.
    void present(const std::function<void(VkCommandBuffer)>& uploads);
    /// Writes picture and panels to a PNG.
    void savePng(const std::string& path);

private:
    void fitText();
    void fitTheme(bool light);

    Host& host_;
    ImGuiContext* context_;
    UiInput input_;
    ControlState controls_;
    double text_scale_ = 0; ///< of the current fonts
    bool light_theme_ = false;
};

} // namespace pointrt
